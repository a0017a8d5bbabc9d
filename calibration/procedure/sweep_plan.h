// Where a sweep looks. A ring around the horizon determines focal length, worm and backlash. A
// block of overlapping pictures above one another determines the parameters that depend on the
// tilt. Pure. The steps are uneven: with even steps the worm's error would look like an
// eccentricity. On the way out, the ring takes every other pose; on the way back, the poses
// between. So neighbours are approached from different sides, and their difference shows the
// backlash.
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
  double ring_tilt_rad = 0.03;  // towards the scenery
  // Whether the unit may look there; other poses are left out. Empty: everywhere.
  std::function<bool(const PanTilt&)> allowed;
};

// Throws std::invalid_argument for fewer than eight poses, or a range that holds none.
std::vector<Shot> plan_sweep(const SweepPlanOptions& options);

}  // namespace ols::calibration
