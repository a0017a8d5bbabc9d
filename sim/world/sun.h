// The sun over the simulated site: its apparent direction, and its disc in a picture, with or
// without a filter on the lens. By ERFA's theory of the Earth's motion, not by the product's own
// sky. Pure.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>

#include "geometry/wgs84.h"

namespace ols::sim {

struct SunTruth {
  Eigen::Vector3d enu = Eigen::Vector3d::UnitZ();  // apparent, with refraction
  double radius_rad = 0.0;
};

// With the air of sim/world/calibration_round.h. Accurate to 1 arc second from 10 degrees of
// elevation up.
SunTruth sun_over(const Geodetic& place, std::int64_t utime_us);

// Draws a black picture: sky and land through a solar filter.
void draw_filter(cv::Mat& gray);

// Draws the sun: with a filter an even disc; without a filter a burnt-out disc whose glare covers
// the picture.
void draw_sun(const Eigen::Vector2d& centre_px, double radius_px, bool filtered, cv::Mat& gray);

}  // namespace ols::sim
