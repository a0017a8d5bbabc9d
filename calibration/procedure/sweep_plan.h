// Plans the pictures of a sweep. A ring around the horizon determines focal length, worm and
// backlash. A block of overlapping pictures, in rows one above the other, determines the parameters
// that depend on the tilt. The steps are uneven: with even steps the worm's error would look like
// an eccentricity. On the way out, the ring takes every second pose; on the way back, the poses in
// between. Neighbouring poses are thus approached from different sides, and their difference shows
// the backlash. Pure.
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
  double ring_tilt_rad = 0.03;  // at which the scenery is visible
  // Whether the unit may look in a direction; other poses are left out. If empty, it may look
  // everywhere.
  std::function<bool(const PanTilt&)> allowed;
};

// Throws std::invalid_argument for fewer than eight poses, or for a range too small for any pose.
std::vector<Shot> plan_sweep(const SweepPlanOptions& options);

}  // namespace ols::calibration
