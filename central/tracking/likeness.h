// When two states are taken for one object's. Pure.
#pragma once

#include "central/filter/interacting_models.h"
#include "central/filter/track_filter.h"

namespace ols::fusion {

// Their positions at one instant are nearer to each other than both know.
bool is_same_place(const KinematicState& a, const KinematicState& b);

// Likewise position and velocity, at the first one's instant.
bool are_duplicates(const TrackFilter& track, const TrackFilter& other);

}  // namespace ols::fusion
