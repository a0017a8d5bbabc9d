// The stationing of the world's stations, as by a field team: each station sights landmarks or
// other stations, and the product's stationing finds its pose (calibration/stationing.h).
#pragma once

#include <cstdint>
#include <vector>

#include "sim/world/world.h"

namespace ols::sim {

// Replaces `nominal` by the result. A landmark's error is the same for all stations; marks are
// drawn for each. step_rad: of the PTUs' encoders. Throws std::invalid_argument if a station cannot
// reach a landmark.
void find_headings(const Scenario& scenario, std::uint64_t seed, double step_rad,
                   std::vector<StationTruth>& stations);

}  // namespace ols::sim
