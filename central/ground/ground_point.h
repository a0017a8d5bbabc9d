// Where a line of sight to an object on the ground ends: a position from one station. Pure.
//
// The position along the line is a mixture: each range r is as probable as the height h(r) by which
// the line passes above the middle of an object there explains it,
//
//   p(r) ~ r / s(r) * exp(-h(r)^2 / 2 s(r)^2) * p(seen | r),   s^2 = s_ground^2 + (r s_elevation)^2
//
// with every range equally probable beforehand. A plane under a steep line makes of it the Gaussian
// with s / tan(grazing angle); a grazing line and one that meets several slopes give what they
// give. Published are mean and covariance of the mixture.
#pragma once

#include <optional>

#include "geometry/direction.h"
#include "land/surface.h"

namespace ols::fusion {

struct GroundPointConfig {
  double max_range_m = 20e3;
  double range_sd_limit = 0.3;  // max 1-sigma along the line, over range
};

// All in ECEF components.
struct GroundPoint {
  Eigen::Vector3d p_ecef;                 // [m] of the object's middle
  Eigen::Matrix3d covariance_ecef;        // [m^2]
  Eigen::Matrix3d covariance_white_ecef;  // [m^2] the part that averaging reduces
  double range_m = 0.0;
};

// Nothing if the line does not end in known ground by more than 3 sigmas, or if the mixture is too
// long to be a position.
std::optional<GroundPoint> ground_point(const land::Surface& surface, const LineOfSight& sight,
                                        const GroundPointConfig& config = {});

}  // namespace ols::fusion
