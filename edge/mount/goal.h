// The goal of a mount: angles to reach, or rates.
#pragma once

#include "geometry/kinematic_chain.h"

namespace ols::mount {

// Angles to reach at an instant, and their rates.
struct Goal {
  double time_s = 0.0;  // on the station's monotonic clock
  PanTilt angles;
  PanTilt rate;                // [rad/s] feed-forward; 0 if the goal is fixed
  double valid_until_s = 0.0;  // the mount halts after this time
  bool rate_only = false;      // only the rates are commanded, from wherever the mount is
  bool rests = false;          // for a fixed goal: the mount comes to rest there
};

}  // namespace ols::mount
