// Predicts when and where a target that the land hides from a station reappears. Pure.
//
// The target's predicted position at each instant is a Gaussian. Sample paths are drawn: a sample
// keeps the same normalised offset from the mean along the whole path. Each sample is compared with
// a horizon of its own, displaced by a random error of the land's model. The result is the mean and
// the covariance of the instants and directions at which the samples reappear.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "central/ground/above_ground.h"
#include "central/ground/land_horizon.h"
#include "central/ground/lost_places.h"
#include "geometry/direction.h"
#include "land/seen_skyline.h"

namespace ols::fusion {

struct Emergence {
  double in_s = 0.0;                                     // time from the first instant of the path
  double sd_s = 0.0;                                     // 1-sigma of in_s
  AzimuthElevation direction;                            // at the camera
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  // [rad^2] cross-elevation, elevation
};

struct Occlusion {
  double hidden = 0.0;            // the probability of being hidden at the first instant
  std::optional<Emergence> exit;  // empty: the target does not reappear within the path
};

// What a station knows to hide targets beyond the model of the land; null where nothing is known.
struct Obstacles {
  const land::SeenSkyline* seen = nullptr;  // the skyline that the station has seen
  const LostPlaces* lost = nullptr;         // where it has lost targets
};

// `path`: the target's predicted positions, at intervals of step_s. nullopt if it is unlikely that
// the target is hidden at any time within lead_s.
std::optional<Occlusion> occlusion_ahead(LandHorizon& horizon, std::span<const Position> path,
                                         double step_s, double lead_s,
                                         const Obstacles& obstacles = {});

}  // namespace ols::fusion
