// The position of a trajectory at an instant.
#pragma once

#include "calibration/observation.h"

namespace ols::calibration {

struct Motion {
  Eigen::Vector3d ecef, velocity_ecef;
  double gap_s = 0.0;  // time between the two positions used; 0 exactly at a position
};

// The position at an instant, on the chord between the two positions around it. Exactly at a
// position, the chord to the next one is used. Beyond the ends, the last chord is extrapolated.
// `trajectory` must have at least two positions.
Motion motion_at(const Trajectory& trajectory, double utime_us);

// In a longer gap between positions, a drone or an aircraft may have been anywhere.
inline constexpr double kLongestGap_s = 3.0;

}  // namespace ols::calibration
