// The Cramer-Rao bound of a target's position at one instant, from one exposure of each station.
// The bound is computed with the true geometry, the scenario's error sigmas and the actual pixel
// noise. The effect of each error on the pixel is a difference quotient of the projection. No
// covariance of the product is used: this bound tests geometry/precision.h.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "sim/world/world.h"

namespace ols::sim {

struct MeasurementNoise {
  double pixel_sd_px = 0.3;  // white
  // Remaining share of the white noise. With 0, averaging has removed all of it, and no smoother
  // can be better than this bound.
  double white_share = 1.0;
};

// Covariance [m^2] in the site's east, north, up; nullopt if these stations do not determine it.
std::optional<Eigen::Matrix3d> position_bound_enu(const World& world, double time_s,
                                                  const std::vector<std::size_t>& stations,
                                                  const MeasurementNoise& noise);

}  // namespace ols::sim
