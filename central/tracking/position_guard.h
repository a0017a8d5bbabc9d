// What a filter's state is worth as a position. Pure.
#pragma once

#include <cstdint>

#include "central/filter/track_filter.h"

namespace ols::fusion {

// With two stations alone one residual has nothing to be checked against: whatever makes their rays
// miss, two objects as well as a wrong heading, is learnt as bias. Whether that is more than what
// they state allows.
bool is_inconsistent_pair(const TrackFilter& filter);

// Of a station that delivers, and that no two others have outvoted since its last used bearing: how
// many in a row are set aside, at most. It follows something else, or the target has turned as
// nobody thought; from kMaxConsecutiveRejections on there is no position, because nobody tells
// which.
int consecutive_rejections(const TrackFilter& filter, std::int64_t now_us);
inline constexpr int kMaxConsecutiveRejections = 6;

// Whether the greatest 1-sigma of the position is below this share of the nearest station's range.
bool has_range(const TrackFilter& filter, const KinematicState& state, double share);

// What a filter's state is worth as a position: kOk, or the named reason why it is none.
Solution judge_position(const TrackFilter& filter, const KinematicState& state);

// Stations whose bearings the filter has used within so long of its own time.
int stations_lately(const TrackFilter& filter, double within_s);

}  // namespace ols::fusion
