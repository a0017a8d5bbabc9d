// Decides whether a track that only two stations support can be where it is. Pure.
#pragma once

#include "central/tracking/track.h"
#include "land/surface.h"

namespace ols::fusion {

// Lines of sight to two objects meet somewhere: often below the ground, or behind the slope that
// one of the objects is on or in front of. True if no three stations support the track, and its
// position is below the ground, or behind what one of their lines of sight ends at, by more than
// 3 sigmas. A third station outweighs the model of the land, which may be wrong. surface: may be
// null.
bool is_behind_land(const TrackFilter& filter, const land::Surface* surface);

}  // namespace ols::fusion
