#include "edge/calibration/drift_watch.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "tests/unit/edge/calibration/drift_test.h"

namespace ols::station {
namespace {

using test::kArcsec;
using test::kStep;
using test::kSteps;
using test::views;

constexpr unsigned kSeed = 20260311;
constexpr std::int64_t kId = 77;

DriftFinding tripod(double heading_arcsec) {
  DriftFinding finding;
  finding.cause = DriftCause::kTripod;
  finding.heading_rad = heading_arcsec * kArcsec;
  finding.heading_sd_rad = finding.tilt_sd_rad = 3.0 * kArcsec;
  return finding;
}

// As the station does: a look that is asked for is taken at once.
bool check(DriftWatch& watch, const Eigen::Vector3d& turned, std::mt19937& random) {
  const auto look = [&] { return watch.add(find_drift(views(turned, random), kSteps)); };
  if (look()) look();
  return watch.level() != DriftLevel::kNone;
}

// A knock about an oblique axis: each part alone is below the limit, what a bearing is off by is
// not.
TEST(DriftWatch, HeadingAndTiltCountTogether) {
  DriftWatch watch({}, kId);
  DriftFinding oblique = tripod(19.0);
  oblique.tilt_rad = 19.0 * kArcsec;
  for (int i = 0; i < 2; ++i) watch.add(oblique);
  EXPECT_EQ(watch.level(), DriftLevel::kAmber);
}

TEST(DriftWatch, BelievesASecondLookOnly) {
  DriftWatch watch({}, kId);
  EXPECT_TRUE(watch.add(tripod(50.0)));
  EXPECT_EQ(watch.level(), DriftLevel::kNone);
  EXPECT_EQ(watch.heading_doubt_rad(), 0.0);
  EXPECT_FALSE(watch.add(tripod(52.0)));
  EXPECT_EQ(watch.level(), DriftLevel::kRed);
  EXPECT_NEAR(watch.heading_doubt_rad() / kArcsec, 52.1, 0.1) << "at once, and all of it";
  EXPECT_NE(watch.alarm().text.find("heading +52"), std::string::npos);
  EXPECT_NE(watch.alarm().text.find("calibrate its setup again"), std::string::npos);
}

TEST(DriftWatch, AGustThatPassesIsNone) {
  DriftWatch watch({}, kId);
  EXPECT_TRUE(watch.add(tripod(50.0)));
  EXPECT_FALSE(watch.add(tripod(2.0)));
  EXPECT_TRUE(watch.add(tripod(50.0))) << "suspected anew, not confirmed";
  EXPECT_EQ(watch.level(), DriftLevel::kNone);
}

TEST(DriftWatch, AmberPassesRedStays) {
  DriftWatch amber({}, kId), red({}, kId);
  for (int i = 0; i < 2; ++i) {
    amber.add(tripod(25.0));
    red.add(tripod(60.0));
  }
  EXPECT_EQ(amber.level(), DriftLevel::kAmber);
  for (int i = 0; i < 3; ++i) {
    amber.add(tripod(1.0));
    red.add(tripod(1.0));
  }
  EXPECT_EQ(amber.level(), DriftLevel::kNone);
  EXPECT_EQ(amber.heading_doubt_rad(), 0.0);
  EXPECT_EQ(red.level(), DriftLevel::kRed);
}

TEST(DriftWatch, ARedOneThatGrowsIsConfirmedAndTakenAnew) {
  DriftWatch watch({}, kId), next({}, kId);
  for (int i = 0; i < 2; ++i) watch.add(tripod(-41.0));
  EXPECT_FALSE(watch.add(tripod(-45.0))) << "no more than checks differ by";
  const int revision = watch.revision();
  EXPECT_TRUE(watch.add(tripod(-600.0)));
  EXPECT_NEAR(watch.heading_doubt_rad() / kArcsec, 41.0, 1.0) << "one look";
  EXPECT_FALSE(watch.add(tripod(-600.0)));
  EXPECT_NEAR(watch.heading_doubt_rad() / kArcsec, 600.0, 1.0);
  EXPECT_EQ(watch.revision(), revision + 1);
  EXPECT_NE(watch.alarm().text.find("heading -600"), std::string::npos);
  EXPECT_TRUE(next.restore(watch.to_text()));
  EXPECT_NEAR(next.heading_doubt_rad() / kArcsec, 600.0, 1.0);
}

TEST(DriftWatch, ATiltThatGrowsIsTakenToo) {
  DriftWatch watch({}, kId);
  DriftFinding tilted = tripod(0.0);
  for (const double tilt_arcsec : {45.0, 45.0, 90.0, 90.0}) {
    tilted.tilt_rad = tilt_arcsec * kArcsec;
    watch.add(tilted);
  }
  EXPECT_NEAR(watch.tilt_doubt_rad() / kArcsec, 90.0, 1.0);
}

TEST(DriftWatch, WhatIsNotCertainIsNotSaid) {
  DriftWatch watch({}, kId);
  DriftFinding vague = tripod(45.0);
  vague.heading_sd_rad = 20.0 * kArcsec;
  EXPECT_FALSE(watch.add(vague));
}

TEST(DriftWatch, AChangedSceneIsSaidAndDoubtsNothing) {
  DriftWatch watch({}, kId);
  DriftFinding scene;
  scene.cause = DriftCause::kScene;
  scene.view = 2;
  EXPECT_TRUE(watch.add(scene));
  watch.add(scene);
  EXPECT_EQ(watch.level(), DriftLevel::kAmber);
  EXPECT_EQ(watch.heading_doubt_rad(), 0.0);
  EXPECT_NE(watch.alarm().text.find("reference view 3"), std::string::npos);
}

TEST(DriftWatch, LostStepsSendToHoming) {
  DriftWatch watch({}, kId);
  DriftFinding lost = tripod(92.6);
  lost.cause = DriftCause::kLostSteps;
  lost.pan = true;
  lost.steps = -2;
  watch.add(lost);
  watch.add(lost);
  EXPECT_NE(watch.alarm().text.find("pan is -2 motor steps"), std::string::npos);
  EXPECT_GT(watch.heading_doubt_rad(), 90.0 * kArcsec);
}

// The views of a unit that counts so many steps beside where it stands.
DriftFinding lost_steps(bool pan, int steps, std::mt19937& random) {
  auto seen = views({0, 0, 0}, random);
  for (ViewOffset& view : seen) {
    if (pan) view.left_rad += steps * kStep * std::cos(view.shafts.tilt_rad);
    if (!pan) view.up_rad += steps * kStep;
  }
  return find_drift(seen, kSteps);
}

TEST(DriftWatch, LostStepsAreDoubtedInWholeOnTheirAxis) {
  std::mt19937 random(kSeed + 2);
  for (const bool pan : {true, false}) {
    for (const int steps : {-3, -2, -1, 1, 2, 3}) {
      DriftWatch watch({}, kId);
      for (int i = 0; i < 2; ++i) watch.add(lost_steps(pan, steps, random));
      const double lost = std::abs(steps) * kStep;
      EXPECT_GE(pan ? watch.heading_doubt_rad() : watch.tilt_doubt_rad(), lost) << pan << steps;
      EXPECT_LT(pan ? watch.tilt_doubt_rad() : watch.heading_doubt_rad(), 0.5 * kStep);
    }
  }
}

TEST(DriftWatch, LostStepsEndAfterTwoQuietChecks) {
  std::mt19937 random(kSeed + 3);
  DriftWatch watch({}, kId);
  for (int i = 0; i < 2; ++i) watch.add(lost_steps(false, 1, random));
  EXPECT_EQ(watch.level(), DriftLevel::kRed);
  watch.add(tripod(1.0));
  EXPECT_EQ(watch.level(), DriftLevel::kRed);
  watch.add(tripod(1.0));
  EXPECT_EQ(watch.level(), DriftLevel::kNone);
  EXPECT_EQ(watch.tilt_doubt_rad(), 0.0);
  EXPECT_TRUE(watch.alarm().empty());
}

TEST(DriftWatch, LostStepsYieldToWhatIsSeenAfterHoming) {
  std::mt19937 random(kSeed + 4);
  DriftWatch watch({}, kId);
  for (int i = 0; i < 2; ++i) watch.add(lost_steps(true, 2, random));
  for (int i = 0; i < 2; ++i) watch.add(tripod(25.0));
  EXPECT_EQ(watch.level(), DriftLevel::kAmber);
  EXPECT_NE(watch.alarm().text.find("the tripod has moved"), std::string::npos);
}

TEST(DriftWatch, SurvivesARestartWithItsCalibrationOnly) {
  DriftWatch watch({}, kId);
  watch.add(tripod(50.0));
  watch.add(tripod(50.0));
  DriftWatch next({}, kId), other({}, kId + 1), broken({}, kId);
  EXPECT_TRUE(next.restore(watch.to_text()));
  EXPECT_EQ(next.level(), DriftLevel::kRed);
  EXPECT_EQ(next.alarm(), watch.alarm());
  EXPECT_EQ(next.heading_doubt_rad(), watch.heading_doubt_rad());
  EXPECT_TRUE(other.restore(watch.to_text()));
  EXPECT_EQ(other.level(), DriftLevel::kNone) << "calibrated since";
  EXPECT_FALSE(broken.restore("drift 1 77 9"));
  EXPECT_FALSE(broken.restore(""));
  EXPECT_EQ(broken.level(), DriftLevel::kNone);
}

// A check every ten minutes, 52 weeks; by day the sun turns the tripod to and fro by 4 arc seconds.
TEST(DriftWatch, AYearOfQuietChecksHasNoAlarm) {
  std::mt19937 random(kSeed);
  constexpr int kChecks = 52 * 7 * 144;
  int alarms = 0;
  DriftWatch watch({}, kId);
  for (int i = 0; i < kChecks; ++i) {
    const double day = 2.0 * kPi * i / 144.0;
    alarms += check(watch, kArcsec * Eigen::Vector3d(2.0 * std::sin(day), 0.0, 4.0 * std::cos(day)),
                    random);
  }
  EXPECT_EQ(alarms, 0);
}

TEST(DriftWatch, AKnockOfFortyIsNoticedAtTheNextCheck) {
  std::mt19937 random(kSeed + 1);
  std::normal_distribution<double> normal;
  int noticed = 0;
  constexpr int kKnocks = 1000;
  for (int i = 0; i < kKnocks; ++i) {
    DriftWatch watch({}, kId);
    check(watch, {0, 0, 0}, random);
    Eigen::Vector3d about(normal(random), normal(random), normal(random));
    noticed += check(watch, 40.0 * kArcsec * about.normalized(), random);
  }
  std::printf("%d of %d knocks noticed at the next check\n", noticed, kKnocks);
  EXPECT_EQ(noticed, kKnocks);
}

}  // namespace
}  // namespace ols::station
