// Separates the bearings of a recording by object, if the recording does not say to which object
// each bearing belongs. Uses the association of the live tracks (central/tracking/live_tracks.h).
// Pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>

#include "central/fusion/fusion.h"
#include "central/offline/bearing_pointers.h"

namespace ols::fusion {

// Whether a station has two bearings of one exposure that point in different directions.
bool shows_several_objects(const MutableBearings& measurements);

struct SeparatedBearings {
  std::map<std::int64_t, MutableBearings> objects{};  // by the identity of the object's track
  std::size_t low_belief = 0;
  std::size_t duplicate = 0;  // same station, stamp and direction
  // Bearings that no track explains, or that two tracks explain about equally well.
  std::size_t unexplained = 0;
};

// The bearings of an object include those that initiated its track, and those of duplicate tracks
// that were merged into its track. `tell` is called after every bearing.
SeparatedBearings separate_objects(const MutableBearings& measurements, const FusionConfig& config,
                                   const std::function<void()>& tell);

}  // namespace ols::fusion
