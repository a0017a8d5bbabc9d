// The true values of each simulated station, to judge a calibration's results.
#pragma once

#include <string>

#include "sim/world/world.h"

namespace ols::sim {

// One JSON object: angles in degrees (`_deg`), metres, pixels; with the names of
// docs/calibration.md.
std::string station_truth(const StationTruth& station);

// FOLDER/ID.json for every station; creates the folder. Throws std::system_error.
void write_station_truths(const World& world, const std::string& folder);

}  // namespace ols::sim
