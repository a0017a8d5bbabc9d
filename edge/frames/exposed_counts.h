// The readings of a pan-tilt unit at one exposure, in the unit's own counts. A calibration uses
// them as observations. Pure.
#pragma once

#include "edge/mount/approach_history.h"
#include "geometry/kinematic_chain.h"

namespace ols::station {

struct ExposedCounts {
  double pan = 0.0, tilt = 0.0;      // [counts]
  double pan_s = 0.0, tilt_s = 0.0;  // [counts/s]
  mount::Approach approach;
  PanTilt count;  // size of a count [rad], as the unit reports it
};

}  // namespace ols::station
