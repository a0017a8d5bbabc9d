// Single sightings of what was followed (drones, aircraft, tracks) that contradict all others.
//
// The sightings of a drone share an offset, so that they are one group; but a detection that sat on
// a bird for one picture does not make the drone's positions wrong. Each sighting, of a track each
// instant, is tested against everything else, beside the groups, and the worst one that fails goes
// first. Where more than a third of a group's sightings fail it is the group that is mistaken, and
// that is left to calibrate().
#pragma once

#include <set>
#include <vector>

#include "calibration/calibrate.h"

namespace ols::calibration {

// Observations, by their index. Empty where there is nothing of the kind. `tell`: as calibrate().
std::set<std::size_t> mistaken_sightings(const Network& network, const Levels& levels = {},
                                         const TellAdjusted& tell = {});

// The network without these sightings of followed targets; its blocks keep their numbers.
Network without(const Network& network, const std::set<std::size_t>& observations);

}  // namespace ols::calibration
