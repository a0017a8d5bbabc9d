// Finds single sightings of followed objects (drones, aircraft, tracks) that contradict all other
// observations.
//
// The sightings of a drone share an offset, so they form one group. But if one detection was in
// fact a bird, the other sightings of the drone are still right. Each sighting (for a track: all
// sightings of one instant) is therefore tested against everything else, in addition to the groups.
// The worst of the sightings that fail is removed first. If more than a third of a group's
// sightings fail, the group itself is mistaken; that is left to calibrate().
#pragma once

#include <set>
#include <vector>

#include "calibration/calibrate.h"

namespace ols::calibration {

// Returns indices of observations; empty if none is mistaken. `tell`: as in calibrate().
std::set<std::size_t> mistaken_sightings(const Network& network, const Levels& levels = {},
                                         const TellAdjusted& tell = {});

// The network without these sightings of followed targets. Its blocks keep their indices.
Network without(const Network& network, const std::set<std::size_t>& observations);

}  // namespace ols::calibration
