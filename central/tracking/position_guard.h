// Whether a position may be told: range, crossing, rejections, an inconsistent pair. Pure.
#pragma once

#include <cstdint>

#include "central/filter/track_filter.h"

namespace ols::fusion {

// With two stations alone nothing checks their residual: whatever makes their rays miss, two
// objects or a wrong heading, is estimated as bias. Returns whether that exceeds the errors that
// they state.
bool is_inconsistent_pair(const TrackFilter& filter);

// Max consecutive rejections of a station that delivers and that no two others have outvoted since
// its last used bearing. It follows another object, or the target has made an unforeseen manoeuvre.
// From kMaxConsecutiveRejections on there is no position, because the bearings cannot distinguish
// the two.
int consecutive_rejections(const TrackFilter& filter, std::int64_t now_us);
inline constexpr int kMaxConsecutiveRejections = 6;

// Whether the largest 1-sigma of the position is below this share of the nearest station's range.
bool has_range(const TrackFilter& filter, const KinematicState& state, double share);

// kOk if a filter's state is good enough for a position, otherwise the reason why not.
Solution judge_position(const TrackFilter& filter, const KinematicState& state);

// Stations with a bearing that the filter used less than this before its own time.
int stations_lately(const TrackFilter& filter, double within_s);

}  // namespace ols::fusion
