// The position of an object on the ground, from a single line of sight: where the line meets the
// ground. Pure.
//
// The position is a mixture over ranges along the line. The probability of a range r depends on
// h(r): how far the line at this range is above the middle of an object that stands on the ground:
//
//   p(r) ~ r / s(r) * exp(-h(r)^2 / 2 s(r)^2) * p(seen | r),   s^2 = s_ground^2 + (r s_elevation)^2
//
// s_ground is the 1-sigma of the ground's height, s_elevation the 1-sigma of the line's elevation.
// All ranges have the same prior probability. p(seen | r) is the probability that the land does not
// hide the point at r from the station. If the ground is a plane and the line is steep, the mixture
// is a Gaussian with the 1-sigma s / tan(grazing angle). If the line is grazing, or meets several
// slopes, the mixture has another shape. The result is the mean and the covariance of the mixture.
#pragma once

#include <optional>

#include "geometry/direction.h"
#include "land/surface.h"

namespace ols::fusion {

struct GroundPointConfig {
  double max_range_m = 20e3;
  double range_sd_limit = 0.3;  // largest 1-sigma along the line, relative to the range
};

// All vectors and matrices are in ECEF components.
struct GroundPoint {
  Eigen::Vector3d p_ecef;                 // [m] the object's middle
  Eigen::Matrix3d covariance_ecef;        // [m^2]
  Eigen::Matrix3d covariance_white_ecef;  // [m^2] the part that averaging reduces
  double range_m = 0.0;
};

// nullopt if it is not certain, to 3 sigmas, that the line meets known ground. Also nullopt if the
// 1-sigma along the line exceeds range_sd_limit.
std::optional<GroundPoint> ground_point(const land::Surface& surface, const LineOfSight& sight,
                                        const GroundPointConfig& config = {});

}  // namespace ols::fusion
