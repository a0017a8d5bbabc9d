// The posterior Cramer-Rao bound of a target that cruises, seen by stations with constant biases of
// known size (Tichavsky, Muravchik, Nehorai 1998): for linear motion it is the recursion of the
// information filter along the true path.
#pragma once

#include <vector>

#include "dev/estimators/bearing_world.h"

namespace ols::bench {

// Mean squared position error [m^2] that no estimator can beat, after the bearings of each frame,
// at the times of the bearings.
std::vector<double> posterior_bound(const WorldConfig& config, const Path& path,
                                    const std::vector<fusion::BearingMeasurement>& bearings,
                                    double disturbance, double position_sd_m,
                                    double velocity_sd_m_s);

}  // namespace ols::bench
