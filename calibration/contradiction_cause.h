// Looks for one mistake that alone explains why observations contradict each other.
#pragma once

#include <string>
#include <vector>

#include "calibration/calibrate.h"

namespace ols::calibration {

// One sentence for each mistake that would explain the whole contradiction. The mistakes tried are:
// two landmarks are exchanged; the sign of an axis is wrong; the two coordinates of the pixels or
// of the landmarks are exchanged; the station's position has a wrong sign. If none of these
// explains the contradiction, the mistakes of mistakes_of_stations() are tried. Empty if no single
// mistake explains the contradiction.
std::vector<std::string> causes_of_contradiction(const Problem& problem, const Levels& levels = {});

// The same for mistakes at a station. Such a mistake looks like several mistaken references. The
// mistakes tried are: the station's position was surveyed wrongly, its tripod was turned between
// two sightings, or its unit lost counts between two sightings. If there are thousands of sightings
// of a drone or an aircraft, only some hundreds of these sightings are tried. The sighting that the
// sentence names may then come a little after the mistake.
std::vector<std::string> mistakes_of_stations(const Problem& problem, const Levels& levels = {});

}  // namespace ols::calibration
