// Decides whether a position may be published, by range, crossing angle, rejections and the
// consistency of a pair. Pure.
#pragma once

#include <cstdint>

#include "central/filter/track_filter.h"

namespace ols::fusion {

// If only two stations deliver, nothing checks their residual: if their rays miss each other for
// whatever reason (two objects, a wrong heading), the filter estimates a bias. Returns whether that
// bias exceeds the errors that the stations state.
bool is_inconsistent_pair(const TrackFilter& filter);

// The largest number of consecutive rejections of a delivering station, unless two other stations
// have agreed since that station's last used bearing. Either the station follows another object, or
// the target has made an unforeseen manoeuvre; the bearings cannot distinguish the two. From
// kMaxConsecutiveRejections on, there is therefore no position.
int consecutive_rejections(const TrackFilter& filter, std::int64_t now_us);
inline constexpr int kMaxConsecutiveRejections = 6;

// Whether the largest 1-sigma of the position is below this share of the range from the nearest
// station.
bool has_range(const TrackFilter& filter, const KinematicState& state, double share);

// kOk if a filter's state is good enough for a position, otherwise the reason.
Solution judge_position(const TrackFilter& filter, const KinematicState& state);

// Number of stations with a bearing that the filter used within the last within_s of its own time.
int stations_lately(const TrackFilter& filter, double within_s);

}  // namespace ols::fusion
