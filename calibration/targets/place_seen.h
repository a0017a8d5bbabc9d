// The view that a station has of a point in ECEF: in GROUND, lifted by terrestrial refraction.
#pragma once

#include "calibration/target.h"

namespace ols::calibration {

// The view of the point, without a nuisance.
TargetView place_seen(const State& state, const Sighting& sighting, const Eigen::Vector3d& ecef);

Eigen::Matrix3d R_enu_ecef(const State& state, const Sighting& sighting);

}  // namespace ols::calibration
