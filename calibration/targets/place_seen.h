// Computes where a station sees a point that is given in ECEF. The result is in the station's
// GROUND, and includes terrestrial refraction.
#pragma once

#include "calibration/target.h"

namespace ols::calibration {

// The view of the point. by_nuisance stays empty.
TargetView place_seen(const State& state, const Sighting& sighting, const Eigen::Vector3d& ecef);

Eigen::Matrix3d R_enu_ecef(const State& state, const Sighting& sighting);

}  // namespace ols::calibration
