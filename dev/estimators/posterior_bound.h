// The posterior Cramer-Rao bound of a cruising target, seen by stations whose biases have a known
// variance (Tichavsky, Muravchik, Nehorai 1998). For linear motion, this bound is the recursion of
// the information filter along the true path.
#pragma once

#include <vector>

#include "dev/estimators/bearing_world.h"

namespace ols::bench {

// The smallest possible mean squared position error [m^2] of any estimator, at the time of each
// bearing and with all bearings up to then.
std::vector<double> posterior_bound(const WorldConfig& config, const Path& path,
                                    const std::vector<fusion::BearingMeasurement>& bearings,
                                    double disturbance, double position_sd_m,
                                    double velocity_sd_m_s);

}  // namespace ols::bench
