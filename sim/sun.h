// The sun over the simulated site: where it appears, and its disc in a picture, with a filter on
// the lens or without. By ERFA's theory of the Earth's motion, not by the product's own sky. Pure.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>

#include "geometry/wgs84.h"

namespace ols::sim {

struct SunTruth {
  Eigen::Vector3d enu = Eigen::Vector3d::UnitZ();  // where it appears, with the refraction in it
  double radius_rad = 0.0;
};

// Over the air of sim/calibration_round.h. Good to 1 arc second from 10 degrees up.
SunTruth sun_over(const Geodetic& place, std::int64_t utime_us);

// A black picture, as the sky and the land are through a filter for the sun.
void draw_filter(cv::Mat& gray);

// With a filter an even disc; without one it is burnt out, and its glare lies over the picture.
void draw_sun(const Eigen::Vector2d& centre_px, double radius_px, bool filtered, cv::Mat& gray);

}  // namespace ols::sim
