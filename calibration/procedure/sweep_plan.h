// Plans the pictures of a sweep. A ring around the horizon determines focal length, the worm's
// error and the backlash. A block of overlapping pictures, in three columns at many different
// elevations, determines the parameters that depend on the tilt. The steps are uneven: with even
// steps, the worm's error would look like an eccentricity. On the way out, the unit stops at every
// second pose of the ring; on the way back, at the poses in between. Neighbouring poses are thus
// approached from different sides, and the difference between them shows the backlash. Pure.
#pragma once

#include <functional>
#include <vector>

#include "calibration/procedure/stage.h"

namespace ols::calibration {

struct SweepPlanOptions {
  int poses = 90;
  PanTilt field_of_view_rad;  // horizontal, vertical
  double pan_min_rad = -2.6, pan_max_rad = 2.6;
  double tilt_min_rad = -0.08, tilt_max_rad = 0.5;
  double ring_tilt_rad = 0.03;  // elevation of the ring: the scenery is visible there
  // Whether the unit may look in a direction; poses where it may not are left out. If empty, the
  // unit may look everywhere.
  std::function<bool(const PanTilt&)> allowed;
};

// Throws std::invalid_argument if there are fewer than eight poses, or if `allowed` leaves fewer
// than eight.
std::vector<Shot> plan_sweep(const SweepPlanOptions& options);

}  // namespace ols::calibration
