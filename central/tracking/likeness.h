// Decides whether the states of two tracks belong to the same object. Pure.
#pragma once

#include "central/filter/interacting_models.h"
#include "central/filter/track_filter.h"

namespace ols::fusion {

// Whether the positions at one instant agree to within both covariances.
bool is_same_place(const KinematicState& a, const KinematicState& b);

// Whether position and velocity agree to within both covariances, at the instant of the first
// track's state.
bool are_duplicates(const TrackFilter& track, const TrackFilter& other);

}  // namespace ols::fusion
