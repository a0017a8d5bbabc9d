// Looks for a single mistake that explains why observations contradict each other.
#pragma once

#include <string>
#include <vector>

#include "calibration/calibrate.h"

namespace ols::calibration {

// One sentence for each mistake that would explain the whole contradiction: two landmarks that were
// exchanged, an axis that counts the other way, exchanged coordinates of the pixels or of the
// landmarks, a wrong sign in the station's position; else a mistake of mistakes_of_stations().
// Empty if no single mistake explains it.
std::vector<std::string> causes_of_contradiction(const Problem& problem, const Levels& levels = {});

// The same for mistakes of a station, which look like several mistaken references: its position is
// surveyed wrongly; or its tripod was turned, or its unit lost its counts, between two sightings.
// If there are thousands of sightings of a drone or an aircraft, some hundreds are tried, so the
// sighting that is named may come a little after the mistake.
std::vector<std::string> mistakes_of_stations(const Problem& problem, const Levels& levels = {});

}  // namespace ols::calibration
