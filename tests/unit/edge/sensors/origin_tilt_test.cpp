#include <gtest/gtest.h>

#include <cmath>

#include "edge/sensors/inclinometer.h"
#include "geometry/angles.h"
#include "geometry/kinematic_chain.h"

namespace ols::sensors {
namespace {

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
