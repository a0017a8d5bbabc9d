// Computes the position on a trajectory at an instant.
#pragma once

#include "calibration/observation.h"

namespace ols::calibration {

struct Motion {
  Eigen::Vector3d ecef, velocity_ecef;
  double gap_s = 0.0;  // time between the two positions used; 0 at the instant of a position
};

// Interpolates linearly between the positions before and after the instant. At the instant of a
// position, the velocity is that towards the next position. Beyond the ends, the first or last two
// positions are extrapolated. `trajectory` must have at least two positions.
Motion motion_at(const Trajectory& trajectory, double utime_us);

// If more time than this is between two positions of a drone or an aircraft, its position between
// them counts as unknown.
inline constexpr double kLongestGap_s = 3.0;

}  // namespace ols::calibration
