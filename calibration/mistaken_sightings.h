// Finds single sightings of followed objects (drones, aircraft, tracks) that contradict the other
// observations.
//
// All sightings of a drone form one group, because they share an offset. But if one detection was
// in fact a bird, the other sightings of the drone are still right. In addition to the groups, each
// sighting (for a track: all sightings of one instant) is therefore tested against all other
// observations. The worst of the sightings that fail is removed first. If more than a third of a
// group's sightings fail, the whole group is mistaken; calibrate() then rejects it.
#pragma once

#include <set>
#include <vector>

#include "calibration/calibrate.h"

namespace ols::calibration {

// Returns the indices of mistaken observations. `tell` is called in each round.
std::set<std::size_t> mistaken_sightings(const Network& network, const Levels& levels = {},
                                         const TellAdjusted& tell = {});

// The network without these sightings of followed targets. The blocks keep their indices.
Network without(const Network& network, const std::set<std::size_t>& observations);

}  // namespace ols::calibration
