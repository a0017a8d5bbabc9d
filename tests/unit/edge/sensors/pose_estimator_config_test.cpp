#include "edge/sensors/pose_estimator_config.h"

#include <gtest/gtest.h>

namespace ols::sensors {
namespace {

TEST(PoseEstimatorConfig, TheEstimatorJudgesAsItsSensorsAreConfigured) {
  GnssConfig gnss;
  gnss.ground_to_antenna_enu_m = {0.1, 0.2, 1.9};
  gnss.least_fix = GnssFix::kRtkFloat;
  gnss.sd_floor_m = 0.03;
  gnss.stale_s = 7.0;
  gnss.accept_move_s = 600.0;
  InclinometerConfig inclinometer;
  inclinometer.sd_rad = 5e-4;
  inclinometer.stale_s = 2.0;
  inclinometer.stuck_s = 90.0;
  PoseEstimator::Config estimator;
  set_sensors(estimator, inclinometer, gnss);
  EXPECT_EQ(estimator.ground_to_antenna_enu_m, Eigen::Vector3d(0.1, 0.2, 1.9));
  EXPECT_EQ(estimator.least_fix, GnssFix::kRtkFloat);
  EXPECT_EQ(estimator.gnss_sd_floor_m, 0.03);
  EXPECT_EQ(estimator.gnss_stale_s, 7.0) << "the receiver's, not the inclinometer's";
  EXPECT_EQ(estimator.accept_move_s, 600.0);
  EXPECT_EQ(estimator.inclinometer_sd_rad, 5e-4);
  EXPECT_EQ(estimator.inclinometer_stale_s, 2.0);
  EXPECT_EQ(estimator.stuck_s, 90.0);
}

TEST(PoseEstimatorConfig, TheSettingsOfThePoseStay) {
  PoseEstimator::Config estimator;
  estimator.alarm_sigma = 3.0;
  estimator.level_sd_rad = 0.01;
  estimator.surveyed_tilt_rad = Eigen::Vector2d(1e-3, 0.0);
  set_sensors(estimator, {}, {});
  EXPECT_EQ(estimator.alarm_sigma, 3.0);
  EXPECT_EQ(estimator.level_sd_rad, 0.01);
  EXPECT_TRUE(estimator.surveyed_tilt_rad);
}

}  // namespace
}  // namespace ols::sensors
