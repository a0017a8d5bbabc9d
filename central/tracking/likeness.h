// When the states of an old and a new track are taken for the same object. Pure.
#pragma once

#include "central/filter/interacting_models.h"
#include "central/filter/track_filter.h"

namespace ols::fusion {

// Their positions at one instant differ by less than both covariances allow.
bool is_same_place(const KinematicState& a, const KinematicState& b);

// Likewise position and velocity, at the first one's instant.
bool are_duplicates(const TrackFilter& track, const TrackFilter& other);

}  // namespace ols::fusion
