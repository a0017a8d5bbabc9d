// What a mount is to do: angles to reach, or rates.
#pragma once

#include "geometry/kinematic_chain.h"

namespace ols::mount {

// Angles to reach at an instant, and their rates.
struct Goal {
  double time_s = 0.0;  // station's monotonic clock
  PanTilt angles;
  PanTilt rate;                // [rad/s] feed-forward; 0 for a fixed goal
  double valid_until_s = 0.0;  // the mount halts after this
  bool rate_only = false;      // only the rates are wanted, from wherever the mount is
  bool rests = false;          // a fixed goal: the mount comes to rest there
};

}  // namespace ols::mount
