// Finds single sightings of followed objects (drones, aircraft, tracks) that contradict all others.
//
// The sightings of a drone share an offset, so they are one group. But a detection that was a bird
// in one picture does not make the drone's positions wrong. Each sighting (of a track: each
// instant) is therefore tested against everything else, in addition to the groups. Of those that
// fail, the worst is removed first. If more than a third of a group's sightings fail, the group
// itself is mistaken; that is left to calibrate().
#pragma once

#include <set>
#include <vector>

#include "calibration/calibrate.h"

namespace ols::calibration {

// Returns indices of observations; empty if none is mistaken. `tell`: as for calibrate().
std::set<std::size_t> mistaken_sightings(const Network& network, const Levels& levels = {},
                                         const TellAdjusted& tell = {});

// The network without these sightings of followed targets. Its blocks keep their numbers.
Network without(const Network& network, const std::set<std::size_t>& observations);

}  // namespace ols::calibration
