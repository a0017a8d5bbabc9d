#include "calibration/procedure/sweep_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <span>

namespace ols::calibration {
namespace {

SweepPlanOptions options() {
  SweepPlanOptions o;
  o.field_of_view_rad = {0.096, 0.072};
  return o;
}

TEST(SweepPlan, NeighboursShareTwoFifthsAndAreApproachedFromBothSides) {
  const auto shots = plan_sweep(options());
  EXPECT_EQ(shots.size(), 90U);
  std::vector<std::pair<double, int>> ring;
  for (const Shot& shot : std::span(shots).first(60)) {
    EXPECT_NEAR(shot.angles.tilt_rad, 0.03, 0.015);
    ring.emplace_back(shot.angles.pan_rad, shot.approach_pan);
  }
  std::ranges::sort(ring);
  int turns = 0;
  for (std::size_t i = 1; i < ring.size(); ++i) {
    EXPECT_LT(ring[i].first - ring[i - 1].first, 0.8 * 0.096);
    turns += ring[i].second != ring[i - 1].second ? 1 : 0;
  }
  EXPECT_GT(turns, static_cast<int>(ring.size()) - 6);
}

// At even steps the worm's error would look like an eccentricity.
TEST(SweepPlan, StepsAreUneven) {
  const auto shots = plan_sweep(options());
  std::set<long> steps;
  for (std::size_t i = 1; i < 36; ++i) {
    steps.insert(std::lround((shots[i].angles.pan_rad - shots[i - 1].angles.pan_rad) * 1e4));
  }
  EXPECT_GT(steps.size(), 20U);
}

TEST(SweepPlan, TheBlockSeesAllPhasesOfTheTiltsWorm) {
  constexpr double kTurn_rad = 2.0 * std::numbers::pi / 70.0;
  const auto shots = plan_sweep(options());
  std::array<int, 8> eighths{};
  double low_rad = 1.0, high_rad = -1.0;
  for (std::size_t i = 60; i < shots.size(); ++i) {
    const double turns = shots[i].angles.tilt_rad / kTurn_rad;
    ++eighths.at(static_cast<std::size_t>(8.0 * (turns - std::floor(turns))));
    low_rad = std::min(low_rad, shots[i].angles.tilt_rad);
    high_rad = std::max(high_rad, shots[i].angles.tilt_rad);
  }
  EXPECT_GE(*std::ranges::min_element(eighths), 1);
  EXPECT_GT(high_rad - low_rad, 2.5 * 0.072);
}

TEST(SweepPlan, TheStatedApproachIsThatOfTheWalk) {
  const auto shots = plan_sweep(options());
  for (std::size_t i = 1; i < shots.size(); ++i) {
    const double pan = shots[i].angles.pan_rad - shots[i - 1].angles.pan_rad;
    const double tilt = shots[i].angles.tilt_rad - shots[i - 1].angles.tilt_rad;
    EXPECT_GE(pan * shots[i].approach_pan, 0.0);
    EXPECT_GE(tilt * shots[i].approach_tilt, 0.0);
    EXPECT_FALSE(shots[i].may_detour);
  }
}

TEST(SweepPlan, ItKeepsToLimitsAndKeepOutRegions) {
  SweepPlanOptions o = options();
  o.pan_min_rad = -0.5;
  o.pan_max_rad = 0.9;
  o.tilt_max_rad = 0.1;
  o.allowed = [](const PanTilt& angles) { return angles.pan_rad < 0.2 || angles.pan_rad > 0.4; };
  const auto shots = plan_sweep(o);
  EXPECT_LT(shots.size(), 90U);
  for (const Shot& shot : shots) {
    EXPECT_GE(shot.angles.pan_rad, -0.5);
    EXPECT_LE(shot.angles.pan_rad, 0.9);
    EXPECT_LE(shot.angles.tilt_rad, 0.1);
    EXPECT_TRUE(o.allowed(shot.angles));
  }
}

TEST(SweepPlan, TooLittleIsRefused) {
  SweepPlanOptions o = options();
  o.poses = 4;
  EXPECT_THROW(plan_sweep(o), std::invalid_argument);
  o = options();
  o.allowed = [](const PanTilt&) { return false; };
  EXPECT_THROW(plan_sweep(o), std::invalid_argument);
}

}  // namespace
}  // namespace ols::calibration
