// Writes the true values of each simulated station, against which a calibration's results are
// tested.
#pragma once

#include <string>

#include "sim/world/world.h"

namespace ols::sim {

// One JSON object with the names of docs/calibration.md; angles in degrees (`_deg`), metres,
// pixels.
std::string station_truth(const StationTruth& station);

// Writes FOLDER/ID.json for every station; creates the folder. Throws std::system_error.
void write_station_truths(const World& world, const std::string& folder);

}  // namespace ols::sim
