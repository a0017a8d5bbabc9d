// Whether a position may be published: range, crossing angle, rejections, inconsistent pair. Pure.
#pragma once

#include <cstdint>

#include "central/filter/track_filter.h"

namespace ols::fusion {

// Two stations alone have nothing that checks their residual: any cause of a miss (two objects, a
// wrong heading) is estimated as bias. Returns whether that bias exceeds the errors that they
// state.
bool is_inconsistent_pair(const TrackFilter& filter);

// The largest number of consecutive rejections of a delivering station, if no two other stations
// have agreed since that station's last used bearing. Either the station follows another object, or
// the target has made an unforeseen manoeuvre; the bearings cannot distinguish the two. From
// kMaxConsecutiveRejections on there is therefore no position.
int consecutive_rejections(const TrackFilter& filter, std::int64_t now_us);
inline constexpr int kMaxConsecutiveRejections = 6;

// Whether the largest 1-sigma of the position is below this share of the nearest station's range.
bool has_range(const TrackFilter& filter, const KinematicState& state, double share);

// kOk if a filter's state is good enough for a position, otherwise the reason.
Solution judge_position(const TrackFilter& filter, const KinematicState& state);

// Number of stations with a bearing that the filter used less than within_s before its own time.
int stations_lately(const TrackFilter& filter, double within_s);

}  // namespace ols::fusion
