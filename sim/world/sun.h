// The sun over the simulated site: its apparent direction, and its disc in a picture, with or
// without a filter on the lens. The direction is computed with ERFA's model of the Earth's motion,
// without the product's calibration/sky.h. Pure.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>

#include "geometry/wgs84.h"

namespace ols::sim {

struct SunTruth {
  Eigen::Vector3d enu = Eigen::Vector3d::UnitZ();  // direction to the apparent sun, with refraction
  double radius_rad = 0.0;
};

// Refraction is that of the air in sim/world/calibration_round.h. Accurate to 1 arc second above 10
// degrees of elevation.
SunTruth sun_over(const Geodetic& place, std::int64_t utime_us);

// Blackens the picture, as a solar filter does with sky and land.
void draw_filter(cv::Mat& gray);

// Draws the sun. With a filter it is a uniform disc; without a filter it is overexposed, and its
// glare covers the picture.
void draw_sun(const Eigen::Vector2d& centre_px, double radius_px, bool filtered, cv::Mat& gray);

}  // namespace ols::sim
