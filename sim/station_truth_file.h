// What is true of each simulated station, for whoever judges what a calibration has found.
#pragma once

#include <string>

#include "sim/world.h"

namespace ols::sim {

// One JSON object: angles in degrees (`_deg`), metres, pixels; the names of docs/calibration.md.
std::string station_truth(const StationTruth& station);

// FOLDER/ID.json for every station; creates the folder. Throws std::system_error.
void write_station_truths(const World& world, const std::string& folder);

}  // namespace ols::sim
