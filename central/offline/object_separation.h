// Which object each bearing of a recording belongs to, where the recording does not say it: the
// live tracks' association (central/tracking/live_tracks.h), looked at afterwards. Pure.
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
  std::size_t duplicate = 0;    // the same station, stamp and direction
  std::size_t unexplained = 0;  // by no track, or by two about equally well
};

// A track's bearings include those from which it was initiated, and those of the duplicates that
// were merged with it. `tell` is called for every bearing.
SeparatedBearings separate_objects(const MutableBearings& measurements, const FusionConfig& config,
                                   const std::function<void()>& tell);

}  // namespace ols::fusion
