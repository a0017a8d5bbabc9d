#include "edge/sensors/pose_estimator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "still_tripod.h"

namespace ols::sensors {
namespace {

using Eigen::Vector3d;
using test::distance_m;
using test::feed;
using test::fix;
using test::kGround;
using test::kSd_m;
using test::no_fix;
using test::sensors_only;
using test::surveyed;
using test::tilt;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(PoseEstimator, KnowsNothingBeforeAnythingWasMeasured) {
  const PoseEstimator estimator(sensors_only());
  const StationPose pose = estimator.pose(5.0);
  EXPECT_EQ(pose.position_source, PoseSource::kNone);
  EXPECT_EQ(pose.tilt_source, PoseSource::kNone);
  EXPECT_EQ(pose.tilt_x_rad, 0.0);
  EXPECT_EQ(pose.tilt_sd_rad, PoseEstimator::Config{}.level_sd_rad);
  EXPECT_THAT(estimator.alarms(5.0), IsEmpty());
}

TEST(PoseEstimator, ASurveyWithoutSensorsStaysAsItIs) {
  const PoseEstimator estimator(surveyed());
  const StationPose pose = estimator.pose(1e6);
  EXPECT_EQ(pose.position_source, PoseSource::kSurveyed);
  EXPECT_EQ(pose.position.latitude_rad, kGround.latitude_rad);
  EXPECT_EQ(pose.position.height_m, kGround.height_m);
  EXPECT_NEAR(pose.position_sd_enu_m.x(), 0.015, 1e-12);
  EXPECT_NEAR(pose.tilt_sd_rad, 1e-4, 1e-12);
  EXPECT_THAT(estimator.alarms(1e6), IsEmpty());
}

TEST(PoseEstimator, SensorsGiveThePoseOfGround) {
  PoseEstimator estimator(sensors_only());
  feed(estimator, 0.0, 20.0);
  const StationPose pose = estimator.pose(20.0);
  EXPECT_EQ(pose.position_source, PoseSource::kSensor);
  EXPECT_LT(distance_m(pose.position, kGround), 1e-3);
  EXPECT_NEAR(pose.position.height_m, 310.0, 1e-3);  // above the ellipsoid, the antenna taken off
  EXPECT_NEAR(degrees(pose.tilt_x_rad), 0.12, 1e-3);
  EXPECT_NEAR(degrees(pose.tilt_y_rad), -0.08, 1e-9);
  EXPECT_EQ(pose.tilt_source, PoseSource::kSensor);
  EXPECT_THAT(estimator.alarms(20.0), IsEmpty());
}

TEST(PoseEstimator, ASurveyOverridesTheSensors) {
  PoseEstimator estimator(surveyed());
  feed(estimator, 0.0, 20.0, Vector3d(0.03, 0.03, -0.03));
  const StationPose pose = estimator.pose(20.0);
  EXPECT_EQ(pose.position.longitude_rad, kGround.longitude_rad);
  EXPECT_NEAR(pose.position_sd_enu_m.x(), 0.015, 1e-12);
  EXPECT_EQ(pose.tilt_source, PoseSource::kSurveyed);
  EXPECT_THAT(estimator.alarms(20.0), IsEmpty());
}

// Errors of GNSS stay for minutes: a thousand readings are not thirty times better than one.
TEST(PoseEstimator, AnAverageIsNeverBetterThanItsReadingsSay) {
  PoseEstimator estimator(sensors_only());
  std::mt19937 random(5);
  std::normal_distribution<double> normal(0.0, kSd_m);
  for (int i = 0; i < 2000; ++i) {
    estimator.add(fix(i, {normal(random), normal(random), normal(random)}));
    estimator.add(tilt(i));
  }
  const StationPose pose = estimator.pose(2000.0);
  EXPECT_NEAR(pose.position_sd_enu_m.z(), kSd_m, 1e-9);
  EXPECT_LT(distance_m(pose.position, kGround), 0.25 * kSd_m);  // and yet it was averaged
  EXPECT_NEAR(pose.tilt_sd_rad, sensors_only().inclinometer_sd_rad, 1e-12);
}

class PoseEstimatorFaults : public testing::TestWithParam<bool> {
 protected:
  PoseEstimator estimator_{GetParam() ? surveyed() : sensors_only()};
  const char* reference_ = GetParam() ? "survey" : "kept position";
};
INSTANTIATE_TEST_SUITE_P(SurveyedOrNot, PoseEstimatorFaults, testing::Bool());

TEST_P(PoseEstimatorFaults, FixLost) {
  feed(estimator_, 0.0, 60.0);
  const StationPose before = estimator_.pose(60.0);
  for (int i = 0; i <= 100; ++i) {
    estimator_.add(no_fix(60.0 + i));
    estimator_.add(tilt(60.0 + i));
  }
  const StationPose after = estimator_.pose(160.0);
  EXPECT_EQ(distance_m(after.position, before.position), 0.0);
  EXPECT_EQ(after.position_source, before.position_source);
  EXPECT_NEAR(after.position_sd_enu_m.x(), std::hypot(before.position_sd_enu_m.x(), 0.1), 1e-3);
  EXPECT_THAT(estimator_.alarms(160.0), ElementsAre("gnss: no fix for 101 s, position kept"));

  feed(estimator_, 161.0, 170.0);
  EXPECT_THAT(estimator_.alarms(170.0), IsEmpty());
  EXPECT_NEAR(estimator_.pose(170.0).position_sd_enu_m.x(), before.position_sd_enu_m.x(), 1e-6);
}

TEST_P(PoseEstimatorFaults, ReceiverSilent) {
  feed(estimator_, 0.0, 60.0);
  const StationPose before = estimator_.pose(60.0);
  EXPECT_THAT(estimator_.alarms(68.0), ElementsAre(HasSubstr("inclinometer: silent")));
  EXPECT_THAT(estimator_.alarms(75.0), ElementsAre("gnss: silent for 16 s, position kept",
                                                   "inclinometer: silent for 15 s, tilt kept"));
  const StationPose after = estimator_.pose(460.0);
  EXPECT_EQ(distance_m(after.position, before.position), 0.0);
  EXPECT_GT(after.position_sd_enu_m.x(), 0.19);
  EXPECT_EQ(after.tilt_x_rad, before.tilt_x_rad);
  EXPECT_GT(after.tilt_sd_rad, 3e-4);
}

TEST_P(PoseEstimatorFaults, PositionJump) {
  feed(estimator_, 0.0, 60.0);
  const StationPose before = estimator_.pose(60.0);
  feed(estimator_, 60.0, 120.0, {103.0, 0.0, 0.0});
  const StationPose after = estimator_.pose(120.0);
  EXPECT_EQ(distance_m(after.position, before.position), 0.0);
  EXPECT_GT(after.position_sd_enu_m.x(), 0.07);
  EXPECT_THAT(estimator_.alarms(120.0),
              ElementsAre(std::string("gnss: 103 m from the ") + reference_));

  feed(estimator_, 120.0, 480.0, {103.0, 0.0, 0.0});
  EXPECT_THAT(estimator_.alarms(480.0),
              ElementsAre(std::string("gnss: 103 m from the ") + reference_ +
                          " for 7 min: set up the station again"));
  EXPECT_LT(distance_m(estimator_.pose(480.0).position, before.position), 1e-9);

  feed(estimator_, 480.0, 490.0);
  EXPECT_THAT(estimator_.alarms(490.0), IsEmpty());
}

TEST_P(PoseEstimatorFaults, ALoneOutlierIsNeitherBelievedNorAnAlarm) {
  feed(estimator_, 0.0, 60.0);
  const StationPose before = estimator_.pose(60.0);
  estimator_.add(fix(60.0, {5.0, 0.0, 0.0}));
  estimator_.add({60.0, radians(2.0), 0.0});
  EXPECT_THAT(estimator_.alarms(60.5), IsEmpty());
  EXPECT_EQ(distance_m(estimator_.pose(60.5).position, before.position), 0.0);
  feed(estimator_, 61.0, 70.0);
  EXPECT_THAT(estimator_.alarms(70.0), IsEmpty());
}

TEST_P(PoseEstimatorFaults, InclinometerStuck) {
  feed(estimator_, 0.0, 60.0);
  const StationPose before = estimator_.pose(60.0);
  for (int i = 0; i < 1600; ++i) {
    TiltReading same = tilt(59.9);
    same.time_s = 60.0 + 0.1 * i;
    estimator_.add(same);
    if (i % 10 == 0) estimator_.add(fix(60.0 + 0.1 * i));
  }
  EXPECT_THAT(estimator_.alarms(220.0), ElementsAre("inclinometer: stuck for 3 min, tilt kept"));
  EXPECT_NEAR(estimator_.pose(220.0).tilt_x_rad, before.tilt_x_rad, radians(0.001));
  EXPECT_GT(estimator_.pose(220.0).tilt_sd_rad, before.tilt_sd_rad + 3e-5);
}

TEST_P(PoseEstimatorFaults, InclinometerDisagrees) {
  feed(estimator_, 0.0, 60.0);
  const StationPose before = estimator_.pose(60.0);
  for (int i = 0; i < 300; ++i) {
    estimator_.add(tilt(60.0 + 0.1 * i, 0.42, -0.08));
    if (i % 10 == 0) estimator_.add(fix(60.0 + 0.1 * i));
  }
  EXPECT_THAT(estimator_.alarms(90.0), ElementsAre(std::string("inclinometer: 0.30 deg from the ") +
                                                   (GetParam() ? "survey" : "kept tilt")));
  EXPECT_EQ(estimator_.pose(90.0).tilt_x_rad, before.tilt_x_rad);
  EXPECT_GT(estimator_.pose(90.0).tilt_sd_rad, before.tilt_sd_rad);
}

TEST(PoseEstimator, AWrongSurveyIsAnAlarmFromTheStart) {
  PoseEstimator estimator(surveyed());
  feed(estimator, 0.0, 10.0, {0.0, 2.5, 0.0});
  EXPECT_THAT(estimator.alarms(10.0), ElementsAre("gnss: 2.50 m from the survey"));
  EXPECT_GT(estimator.pose(10.0).position_sd_enu_m.x(), 0.03);
}

// Whatever comes, the pose is finite, the survey is never given up, and no sd is below what it was
// at the start.
TEST(PoseEstimator, HoldsWhateverComes) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    const bool with_survey = seed % 2 == 0;
    PoseEstimator estimator(with_survey ? surveyed() : sensors_only());
    const double odd[] = {std::nan(""), std::numeric_limits<double>::infinity(), 1e300, -1.0, 0.0};
    const auto spoil = [&](double& value) {
      if (random() % 20 == 0) value = odd[random() % std::size(odd)];
    };
    std::normal_distribution<double> normal;
    double now_s = 0.0;
    for (int i = 0; i < 3000; ++i) {
      now_s += 0.1;
      const double scale_m = random() % 10 == 0 ? 1e3 : kSd_m;
      GnssReading r = fix(now_s, scale_m * Vector3d(normal(random), normal(random), 0.0));
      r.fix = static_cast<GnssFix>(random() % 6);
      spoil(r.antenna.latitude_rad), spoil(r.antenna.height_m), spoil(r.time_s);
      spoil(r.sd_enu_m.x());
      estimator.add(r);
      TiltReading t = tilt(now_s, normal(random), normal(random));
      spoil(t.tilt_x_rad), spoil(t.time_s);
      estimator.add(t);
      const StationPose pose = estimator.pose(now_s);
      ASSERT_TRUE(std::isfinite(pose.position.latitude_rad + pose.position.height_m));
      ASSERT_TRUE(pose.position_sd_enu_m.allFinite());
      ASSERT_TRUE(std::isfinite(pose.tilt_x_rad + pose.tilt_y_rad + pose.tilt_sd_rad));
      if (pose.position_source != PoseSource::kNone) {
        ASSERT_GE(pose.position_sd_enu_m.minCoeff(), 0.01 - 1e-9);
      }
      if (with_survey) {
        ASSERT_EQ(distance_m(pose.position, kGround), 0.0);
      }
      estimator.alarms(now_s);
    }
  }
}

}  // namespace
}  // namespace ols::sensors
