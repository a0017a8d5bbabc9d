// The pose over a restart.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "edge/sensors/pose_estimator.h"
#include "still_tripod.h"

namespace ols::sensors {
namespace {

using Eigen::Vector3d;
using test::distance_m;
using test::fix;
using test::kGround;
using test::kSd_m;
using test::moved;
using test::no_fix;
using test::sensors_only;
using test::surveyed;
using test::tilt;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::int64_t kUtime_us = 1'700'000'000'000'000;

PersistedPose remembered() {
  PoseEstimator before(sensors_only());
  for (int i = 0; i < 20; ++i) {
    before.add(fix(i));
    before.add(tilt(i));
  }
  return before.to_persist(20.0, kUtime_us);
}

TEST(PoseEstimatorResumed, ARestartWithoutAFixStillKnowsWhereItIs) {
  PoseEstimator estimator(sensors_only());
  estimator.resume(remembered(), 1000.0, kUtime_us + 120'000'000);
  const StationPose pose = estimator.pose(1000.0);
  EXPECT_EQ(pose.position_source, PoseSource::kSensor);
  EXPECT_EQ(pose.tilt_source, PoseSource::kSensor);
  EXPECT_LT(distance_m(pose.position, kGround), 1e-3);
  EXPECT_NEAR(pose.tilt_x_rad, radians(0.12), radians(0.001));
  // The age of two minutes counts, and so does what comes on top of it.
  EXPECT_NEAR(pose.position_sd_enu_m.x(), std::hypot(kSd_m, 0.01 * std::sqrt(120.0)), 1e-3);
  EXPECT_NEAR(estimator.pose(1900.0).position_sd_enu_m.x(),
              std::hypot(kSd_m, 0.01 * std::sqrt(1020.0)), 1e-3);
  EXPECT_GT(estimator.pose(1900.0).tilt_sd_rad, pose.tilt_sd_rad);
  EXPECT_THAT(estimator.alarms(1000.0),
              ElementsAre("pose: position restored from before the restart, 2 min old",
                          "pose: tilt restored from before the restart, 2 min old"));
}

TEST(PoseEstimatorResumed, ASensorConfirmsIt) {
  PoseEstimator estimator(sensors_only());
  estimator.resume(remembered(), 1000.0, kUtime_us + 120'000'000);
  estimator.add(fix(1001.0));
  estimator.add(tilt(1001.0));
  EXPECT_THAT(estimator.alarms(1001.0), IsEmpty());
  EXPECT_LT(estimator.pose(1001.0).position_sd_enu_m.x(), 0.06);
}

TEST(PoseEstimatorResumed, UntilThenItIsNotKeptAnew) {
  PoseEstimator estimator(sensors_only());
  estimator.resume(remembered(), 1000.0, kUtime_us);
  EXPECT_FALSE(estimator.to_persist(1001.0, kUtime_us).position) << "its age would be forgotten";
  estimator.add(no_fix(1001.0));
  EXPECT_FALSE(estimator.to_persist(1001.0, kUtime_us).position);
  estimator.add(fix(1002.0));
  EXPECT_TRUE(estimator.to_persist(1002.0, kUtime_us).position);
  EXPECT_FALSE(estimator.to_persist(1002.0, kUtime_us).tilt);
}

TEST(PoseEstimatorResumed, SensorsThatSayOtherwiseForAMinuteAreRight) {
  PoseEstimator estimator(sensors_only());
  estimator.resume(remembered(), 1000.0, kUtime_us);
  const Vector3d carried{100.0, 0.0, 0.0};
  double now_s = 1000.0;
  for (; now_s < 1050.0; now_s += 1.0) estimator.add(fix(now_s, carried));
  EXPECT_LT(distance_m(estimator.pose(now_s).position, kGround), 1e-3) << "a jump alone is none";
  EXPECT_THAT(estimator.alarms(now_s), testing::Contains(HasSubstr("from the kept position")));
  for (; now_s < 1070.0; now_s += 1.0) estimator.add(fix(now_s, carried));
  EXPECT_NEAR(distance_m(estimator.pose(now_s).position, kGround), 100.0, 0.1);
  EXPECT_THAT(estimator.alarms(now_s), testing::Contains(HasSubstr("check the heading")));
  EXPECT_TRUE(estimator.to_persist(now_s, kUtime_us).position);
}

TEST(PoseEstimatorResumed, AClockThatWentBackTellsNoAge) {
  PoseEstimator estimator(sensors_only());
  estimator.resume(remembered(), 1000.0, kUtime_us - 3'600'000'000);
  EXPECT_GT(estimator.pose(1000.0).position_sd_enu_m.x(), 4.0);
  EXPECT_EQ(estimator.pose(1000.0).position_source, PoseSource::kSensor);
}

TEST(PoseEstimatorResumed, WhatIsOldOrSurveyedIsNotTakenUp) {
  PoseEstimator old(sensors_only());
  old.resume(remembered(), 1000.0, kUtime_us + 8LL * 86400 * 1'000'000);
  EXPECT_EQ(old.pose(1000.0).position_source, PoseSource::kNone);
  EXPECT_THAT(old.alarms(1000.0), IsEmpty());
  PoseEstimator::Config c = sensors_only();
  c.surveyed_position = moved(kGround, {5.0, 0.0, 0.0});
  c.surveyed_tilt_rad = Eigen::Vector2d(0.01, 0.02);
  PoseEstimator surveyed(c);
  surveyed.resume(remembered(), 1000.0, kUtime_us);
  EXPECT_EQ(surveyed.pose(1000.0).position_source, PoseSource::kSurveyed);
  EXPECT_NEAR(distance_m(surveyed.pose(1000.0).position, kGround), 5.0, 1e-3);
  EXPECT_EQ(surveyed.pose(1000.0).tilt_x_rad, 0.01);
  EXPECT_THAT(surveyed.alarms(1000.0), IsEmpty());
  EXPECT_FALSE(surveyed.to_persist(1000.0, kUtime_us).position);
}

}  // namespace
}  // namespace ols::sensors
