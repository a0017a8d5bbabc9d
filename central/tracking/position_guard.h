// Decides whether a track's position may be published. Judges its range, the crossing angle of the
// rays, the rejections, and whether a pair of stations is consistent. Pure.
#pragma once

#include <cstdint>

#include "central/filter/track_filter.h"

namespace ols::fusion {

// Whether only two stations support the track, and the estimated biases of these two exceed the
// errors that they state. With only two stations, rays that miss each other for whatever reason
// (two objects, a wrong heading) leave no residual: the filter explains the miss by biases.
bool is_inconsistent_pair(const TrackFilter& filter);

// The largest number of consecutive rejections of a delivering station. A station is ignored if
// bearings of at least two other stations have been used since its own last used bearing. A station
// with many rejections follows another object, or the target has made an unforeseen manoeuvre; the
// bearings cannot distinguish the two. With kMaxConsecutiveRejections or more, no position is
// therefore published.
int consecutive_rejections(const TrackFilter& filter, std::int64_t now_us);
inline constexpr int kMaxConsecutiveRejections = 6;

// Whether the largest 1-sigma of the position is below this share of the range from the nearest
// station.
bool has_range(const TrackFilter& filter, const KinematicState& state, double share);

// kOk if a filter's state is good enough to publish its position, otherwise the reason why not.
Solution judge_position(const TrackFilter& filter, const KinematicState& state);

// The number of stations from which the filter has used a bearing within the last within_s of the
// filter's time.
int stations_lately(const TrackFilter& filter, double within_s);

}  // namespace ols::fusion
