#include "edge/calibration/drift_finding.h"

#include <gtest/gtest.h>

#include "tests/unit/edge/calibration/drift_test.h"

namespace ols::station {
namespace {

using test::kArcsec;
using test::kSd;
using test::kStep;
using test::kSteps;
using test::views;

constexpr unsigned kSeed = 20260310;

TEST(DriftFinding, ATurnedTripodIsFoundWithItsHeadingAndTilt) {
  std::mt19937 random(kSeed);
  const auto finding =
      find_drift(views(kArcsec * Eigen::Vector3d(30.0, 40.0, -70.0), random, 0.0), kSteps);
  EXPECT_EQ(finding.cause, DriftCause::kTripod);
  EXPECT_NEAR(finding.heading_rad / kArcsec, 70.0, 0.1) << "clockwise";
  EXPECT_NEAR(finding.tilt_rad / kArcsec, 50.0, 0.1);
  EXPECT_NEAR(finding.heading_sd_rad, 0.5 * kSd, 0.02 * kSd) << "of four views";
}

TEST(DriftFinding, ItsDeviationsAreThoseOfManyChecks) {
  std::mt19937 random(kSeed + 1);
  double squares = 0.0;
  constexpr int kChecks = 2000;
  for (int i = 0; i < kChecks; ++i) {
    const auto finding = find_drift(views({0, 0, -60.0 * kArcsec}, random), kSteps);
    squares += std::pow((finding.heading_rad - 60.0 * kArcsec) / finding.heading_sd_rad, 2);
  }
  EXPECT_NEAR(squares / kChecks, 1.0, 0.1);
}

TEST(DriftFinding, OneViewThatMovedIsTheScene) {
  std::mt19937 random(kSeed + 2);
  for (std::size_t moved = 0; moved < 4; ++moved) {
    auto seen = views({0, 0, 0}, random);
    seen[moved].left_rad += 90.0 * kArcsec;
    seen[moved].up_rad -= 60.0 * kArcsec;
    const auto finding = find_drift(seen, kSteps);
    EXPECT_EQ(finding.cause, DriftCause::kScene);
    EXPECT_EQ(finding.view, moved);
    EXPECT_LT(std::abs(finding.heading_rad), 4.0 * finding.heading_sd_rad);
  }
}

TEST(DriftFinding, WholeStepsOfAnAxisAreLostSteps) {
  std::mt19937 random(kSeed + 3);
  auto pan = views({0, 0, 0}, random), tilt = pan;
  for (ViewOffset& view : pan) view.left_rad += 4 * kStep * std::cos(view.shafts.tilt_rad);
  for (ViewOffset& view : tilt) view.up_rad -= 2 * kStep;
  const auto lost_pan = find_drift(pan, kSteps), lost_tilt = find_drift(tilt, kSteps);
  EXPECT_EQ(lost_pan.cause, DriftCause::kLostSteps);
  EXPECT_TRUE(lost_pan.pan);
  EXPECT_EQ(lost_pan.steps, 4);
  EXPECT_EQ(lost_tilt.cause, DriftCause::kLostSteps);
  EXPECT_FALSE(lost_tilt.pan);
  EXPECT_EQ(lost_tilt.steps, -2);
}

// Each axis has its own gear.
TEST(DriftFinding, AnotherGearLosesOtherSteps) {
  StationModel model;
  model.pan.worm_teeth = 100;
  const MotorSteps steps = motor_steps(model);
  EXPECT_NEAR(steps.pan_rad / kArcsec, 32.4, 1e-6);
  EXPECT_NEAR(steps.tilt_rad / kArcsec, 46.2857, 1e-3);
  std::mt19937 random(kSeed + 6);
  auto seen = views({0, 0, 0}, random);
  for (ViewOffset& view : seen) view.left_rad += 2 * steps.pan_rad * std::cos(view.shafts.tilt_rad);
  const auto lost = find_drift(seen, steps);
  EXPECT_EQ(lost.cause, DriftCause::kLostSteps);
  EXPECT_EQ(lost.steps, 2);
  EXPECT_EQ(find_drift(seen, kSteps).cause, DriftCause::kTripod);
}

TEST(DriftFinding, AHeadingThatIsNoStepIsTheTripod) {
  std::mt19937 random(kSeed + 4);
  const auto finding = find_drift(views({0, 0, 1.5 * kStep}, random), kSteps);
  EXPECT_EQ(finding.cause, DriftCause::kTripod);
}

TEST(DriftFinding, WhatAgreesOnNothingIsUnclear) {
  std::mt19937 random(kSeed + 5);
  auto seen = views({0, 0, 0}, random);
  seen[0].up_rad += 150.0 * kArcsec;
  seen[1].left_rad -= 200.0 * kArcsec;
  EXPECT_EQ(find_drift(seen, kSteps).cause, DriftCause::kUnclear);
  seen.resize(2);
  EXPECT_EQ(find_drift(seen, kSteps).cause, DriftCause::kUnclear) << "two views";
}

}  // namespace
}  // namespace ols::station
