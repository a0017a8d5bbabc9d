#include "calibration/parameter_change.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/calibration/star_scene.h"

namespace ols::calibration {
namespace {

using test::named_stars;
using test::night_sky;

constexpr std::uint64_t kSeed = 41;

ClockCheck clock_of(const Problem& problem) {
  const Adjustment adjustment(network_of(problem));
  return clock_check(adjustment.network(), calibrate(adjustment).fit);
}

// Stars, and landmarks if wanted, by a clock that is 5 s fast.
Problem by_a_fast_clock(int landmarks) {
  const auto sky = night_sky(kSeed, {.frames = 16, .false_detections = 0});
  Problem problem = named_stars(sky);
  problem.ut1_sd_s = 0.05;
  for (Observation& one : problem.observations) one.utime_us += 5'000'000;
  for (int i = 0; i < landmarks; ++i) {
    const std::string name = "landmark" + std::to_string(i);
    const Observation one = test::landmark(-140.0 + 280.0 * i / (landmarks - 1), 1.0, name);
    problem.references[name] = test::place_seen(sky.truth, one, 800.0 + 100.0 * i);
    problem.observations.push_back(one);
  }
  return problem;
}

TEST(ParameterChange, StarsAloneDoNotCheckTheirClock) {
  const ClockCheck check = clock_of(by_a_fast_clock(0));
  EXPECT_FALSE(check.is_large());
  EXPECT_GT(check.detectable_s(), 60.0);
}

TEST(ParameterChange, LandmarksCheckTheClockOfTheStars) {
  const ClockCheck check = clock_of(by_a_fast_clock(8));
  std::printf("fast by %.2f s, 1-sigma %.2f s\n", check.fast_s, check.sd_s);
  EXPECT_TRUE(check.is_large());
  EXPECT_NEAR(check.fast_s, 5.0, 3.0 * check.sd_s);
  EXPECT_LT(check.sd_s, 1.5);
}

TEST(ParameterChange, ObservationsThatScatterMoreCheckTheClockLess) {
  const Problem problem = by_a_fast_clock(8);
  const Adjustment adjustment(network_of(problem));
  const Fit fit = calibrate(adjustment).fit;
  const ClockCheck stated = clock_check(adjustment.network(), fit);
  const ClockCheck scaled = clock_check(adjustment.network(), fit, 3.0);
  EXPECT_EQ(scaled.fast_s, stated.fast_s);
  const auto of_others = [&](const ClockCheck& check) {
    return std::sqrt(check.sd_s * check.sd_s - problem.ut1_sd_s * problem.ut1_sd_s);
  };
  EXPECT_NEAR(of_others(scaled), 3.0 * of_others(stated), 1e-9);
}

// Its angles are off by 5 arc seconds each.
TEST(ParameterChange, ScatterOfThePosesIsNoticedBesideManyPixels) {
  Problem problem = named_stars(night_sky(kSeed, {.frames = 30, .false_detections = 0}));
  const auto scatter = [&problem] {
    const Adjustment adjustment(network_of(problem));
    return pose_scatter(adjustment, calibrate(adjustment).fit);
  };
  EXPECT_EQ(scatter(), 1.0);
  problem.stations[0].pose_sd_rad = 2.0 * test::kArcsec;
  const double factor = scatter();
  std::printf("scatter %.2f times as stated\n", factor);
  EXPECT_GT(factor, 1.6);
  EXPECT_LT(factor, 3.5);
}

}  // namespace
}  // namespace ols::calibration
