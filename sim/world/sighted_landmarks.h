// Performs the stationing of all stations as a field team would: each station sights landmarks or
// other stations, and the product's stationing (calibration/stationing.h) computes the station's
// pose.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/world/world.h"

namespace ols::sim {

// Replaces each station's `nominal` geometry by the result. The position error of a landmark is the
// same for all stations; the errors of the operators' marks are independent. `step_rad`: of the
// PTUs' encoders. Throws std::invalid_argument if a station cannot reach a landmark.
void find_headings(const Scenario& scenario, std::uint64_t seed, double step_rad,
                   std::vector<StationTruth>& stations);

}  // namespace ols::sim
