// When and where a target that the land hides from a station comes out again. Pure.
//
// The target's path ahead is a Gaussian at each instant. Samples of it are compared with the
// horizon: each sample keeps its standard-normal offset along the whole path, and has a horizon of
// its own, wrong by as much as the land's model may be. The instants and directions at which they
// come out have the mean and the covariance that are stated.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "central/ground/above_ground.h"
#include "central/ground/land_horizon.h"
#include "geometry/direction.h"

namespace ols::fusion {

struct Emergence {
  double in_s = 0.0;  // from the first instant of the path
  double sd_s = 0.0;
  AzimuthElevation direction;                            // at the camera
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  // [rad^2] cross-elevation, elevation
};

struct Occlusion {
  double hidden = 0.0;            // the probability that it is hidden at the first instant
  std::optional<Emergence> exit;  // empty: not within the path
};

// `path`: of the target, a position every step_s. Nothing if it cannot be hidden within lead_s.
std::optional<Occlusion> occlusion_ahead(LandHorizon& horizon, std::span<const Position> path,
                                         double step_s, double lead_s);

}  // namespace ols::fusion
