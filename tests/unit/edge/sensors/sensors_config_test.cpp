#include <gtest/gtest.h>

#include "base/config/config_section.h"
#include "edge/sensors/dpg2/dpg2_kind.h"
#include "edge/sensors/gpsd/gpsd_kind.h"
#include "edge/sensors/pose_estimator_config.h"
#include "geometry/angles.h"

namespace ols::sensors {
namespace {

Dpg2Config inclinometer(const std::string& text) {
  ConfigFile file(text, "t.toml");
  Dpg2Kind kind;
  config::read(kind.section(), file.root().table("inclinometer"));
  return kind.dpg2;
}

GpsdConfig gnss(const std::string& text) {
  ConfigFile file(text, "t.toml");
  GpsdKind kind;
  config::read(kind.section(), file.root().table("gnss"));
  return kind.gpsd;
}

TEST(SensorsConfig, EveryKeyArrives) {
  const auto i = inclinometer(R"([inclinometer]
device = "/dev/ttyUSB1"
baud = 19200
parity = "even"
stale_s = 2.5
stuck_s = 30.0
swap_axes = true
x_sign = -1
y_sign = 1
x_zero_deg = 0.5
y_zero_deg = -0.25
range_deg = 20.0
sd_deg = 0.02
)");
  EXPECT_EQ(i.device, "/dev/ttyUSB1");
  EXPECT_EQ(i.baud, 19200);
  EXPECT_TRUE(i.even_parity);
  EXPECT_TRUE(i.swap_axes);
  EXPECT_EQ(i.x_sign, -1);
  EXPECT_NEAR(i.x_zero_rad, radians(0.5), 1e-15);
  EXPECT_NEAR(i.y_zero_rad, radians(-0.25), 1e-15);
  const auto g = gnss(R"([gnss]
host = "127.0.0.1"
port = 2950
stale_s = 4.0
least_fix = "rtk-float"
ground_to_antenna_enu_m = [0.1, -0.2, 1.8]
sd_floor_m = 0.03
error_sigmas = 2.0
accept_move_s = 900.0
)");
  EXPECT_EQ(g.host, "127.0.0.1");
  EXPECT_EQ(g.port, "2950");
  EXPECT_EQ(g.error_sigmas, 2.0);
  PoseEstimator::Config estimator;
  set_sensors(estimator, i, g);
  EXPECT_EQ(estimator.stuck_s, 30.0);
  EXPECT_EQ(estimator.inclinometer_stale_s, 2.5);
  EXPECT_NEAR(estimator.inclinometer_sd_rad, radians(0.02), 1e-15);
  EXPECT_EQ(estimator.gnss_stale_s, 4.0);
  EXPECT_EQ(estimator.least_fix, GnssFix::kRtkFloat);
  EXPECT_EQ(estimator.ground_to_antenna_enu_m, Eigen::Vector3d(0.1, -0.2, 1.8));
  EXPECT_EQ(estimator.gnss_sd_floor_m, 0.03);
  EXPECT_EQ(estimator.accept_move_s, 900.0);
}

TEST(SensorsConfig, TheSettingsOfThePoseStay) {
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
