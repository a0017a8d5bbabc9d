#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "edge/sensors/alarm_format.h"
#include "edge/sensors/gnss_reading.h"
#include "edge/sensors/inclinometer.h"
#include "geometry/angles.h"
#include "geometry/kinematic_chain.h"

namespace ols::sensors {
namespace {

TEST(AlarmFormat, ALengthHasTheUnitThatSuitsIt) {
  EXPECT_EQ(format_length(0.0), "0.00 m");
  EXPECT_EQ(format_length(0.314), "0.31 m");
  EXPECT_EQ(format_length(103.4), "103 m");
  EXPECT_EQ(format_length(10e3), "10 km");
  EXPECT_EQ(format_length(12'345.0), "12 km");
}

TEST(AlarmFormat, ATimeHasTheUnitThatSuitsIt) {
  EXPECT_EQ(format_time(12.4), "12 s");
  EXPECT_EQ(format_time(119.0), "119 s");
  EXPECT_EQ(format_time(120.0), "2 min");
  EXPECT_EQ(format_time(7199.0), "120 min");
  EXPECT_EQ(format_time(7200.0), "2 h");
}

TEST(AlarmFormat, AnAngleIsInDegrees) { EXPECT_EQ(format_angle(radians(0.314)), "0.31 deg"); }

// "at least RTK float" is a comparison.
TEST(GnssReading, ABetterFixIsGreater) {
  EXPECT_LT(GnssFix::kNone, GnssFix::k2D);
  EXPECT_LT(GnssFix::k2D, GnssFix::k3D);
  EXPECT_LT(GnssFix::k3D, GnssFix::kDifferential);
  EXPECT_LT(GnssFix::kDifferential, GnssFix::kRtkFloat);
  EXPECT_LT(GnssFix::kRtkFloat, GnssFix::kRtkFixed);
}

TEST(GnssReading, EachFixHasANameOfItsOwn) {
  std::set<std::string> names;
  const int best = static_cast<int>(GnssFix::kRtkFixed);
  for (int i = 0; i <= best; ++i) names.insert(to_string(static_cast<GnssFix>(i)));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(best + 1));
  EXPECT_STREQ(to_string(GnssReading{}.fix), "no fix");
}

TEST(OriginTilt, IsTheTiltOfTheChainThatTheAxesShow) {
  for (const double x_deg : {-20.0, -0.3, 0.0, 0.1, 10.0}) {
    for (const double y_deg : {-15.0, 0.0, 0.2, 25.0}) {
      ChainParameters chain;
      chain.heading_rad = 1.0;
      chain.tilt_x_rad = radians(x_deg);
      chain.tilt_y_rad = radians(y_deg);
      const Eigen::Matrix3d R =
          joints(chain, {})[static_cast<std::size_t>(Joint::kOrigin)].linear();
      // An axis of the sensor shows its own inclination to the horizontal.
      AxisAngles shown;
      shown.time_s = 3.0;
      shown.x_rad = std::asin(R.col(1).z());   // left side up
      shown.y_rad = std::asin(-R.col(0).z());  // nose down
      const TiltReading tilt = origin_tilt({}, shown);
      EXPECT_NEAR(tilt.tilt_x_rad, chain.tilt_x_rad, 1e-12);
      EXPECT_NEAR(tilt.tilt_y_rad, chain.tilt_y_rad, 1e-12);
      EXPECT_EQ(tilt.time_s, 3.0);
    }
  }
}

TEST(OriginTilt, TheMountingOfTheSensorIsTakenOff) {
  InclinometerConfig config;
  config.swap_axes = true;
  config.x_sign = -1;
  config.x_zero_rad = 0.010;
  config.y_zero_rad = -0.020;
  const TiltReading tilt = origin_tilt(config, {0.0, -0.019, 0.013});
  EXPECT_NEAR(tilt.tilt_x_rad, -0.003, 1e-12);
  EXPECT_NEAR(tilt.tilt_y_rad, 0.001, 1e-8);
}

}  // namespace
}  // namespace ols::sensors
