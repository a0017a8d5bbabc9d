// How long a station counts as active after its last bearing. Each purpose has its own time window.
#pragma once

#include <algorithm>
#include <cstdint>

#include "central/measurement/time_span.h"

namespace ols::fusion {

struct Activity {
  // The windows. Some of them are defaults of configured values.
  static constexpr double kDeliversS = 0.3;  // the station counts for "now", and as seeing a target
  static constexpr double kContributesS = 0.5;  // it contributes to the published position
  static constexpr double kFollowsS = 1.0;      // it keeps its target, and its states in a filter
  static constexpr double kSupportsS = 2.0;     // it supports a track
  // Its bearings still constrain the estimated biases of other stations.
  static constexpr double kTeachesS = 30.0;

  std::int64_t last_us = 0;  // time of the newest bearing; 0 if there is none

  void note(std::int64_t utime_us) { last_us = std::max(last_us, utime_us); }
  double age_s(std::int64_t now_us) const { return seconds(now_us - last_us); }
  bool within(double window_s, std::int64_t now_us) const { return age_s(now_us) <= window_s; }
};

}  // namespace ols::fusion
