// Separates the objects of a recording that does not name them, by running the live tracks'
// association (central/tracking/live_tracks.h) and reading its result afterwards. Pure.
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
  std::map<std::int64_t, MutableBearings> objects{};  // by the tracks' identities
  std::size_t low_belief = 0;
  std::size_t duplicate = 0;    // same station, stamp and direction
  std::size_t unexplained = 0;  // explained by no track, or by two tracks about equally well
};

// A track's bearings include those from which it was initiated, and those of merged duplicates.
// `tell` is called for every bearing.
SeparatedBearings separate_objects(const MutableBearings& measurements, const FusionConfig& config,
                                   const std::function<void()>& tell);

}  // namespace ols::fusion
