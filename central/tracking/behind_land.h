// Decides whether the land allows the position of a track that only two stations support. Pure.
#pragma once

#include "central/tracking/track.h"
#include "land/surface.h"

namespace ols::fusion {

// Lines of sight to two different objects often meet below the ground, or behind the slope where
// one of the objects is. Returns true if two conditions hold: fewer than three stations support the
// track; and, by more than 3 sigmas, the track's position is below the ground or behind the point
// where a station's line of sight meets the land. If a third station agrees, the position is
// believed, and not the model of the land: the model may be wrong. surface: may be null.
bool is_behind_land(const TrackFilter& filter, const land::Surface* surface);

}  // namespace ols::fusion
