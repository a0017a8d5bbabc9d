// The goal of a mount: angles to reach, or rates.
#pragma once

#include "geometry/kinematic_chain.h"

namespace ols::mount {

// If rate_only is false, the mount must reach `angles` at time_s, and must then move at `rate`.
struct Goal {
  double time_s = 0.0;  // on the station's monotonic clock
  PanTilt angles;
  PanTilt rate;                // [rad/s] feed-forward; 0 for a fixed goal
  double valid_until_s = 0.0;  // the mount halts after this time
  bool rate_only = false;      // true: only `rate` is ordered, wherever the mount is
  bool rests = false;          // for a fixed goal: the mount must come to rest there
};

}  // namespace ols::mount
