// Where something that tells its positions in time was at an instant.
#pragma once

#include "calibration/observation.h"

namespace ols::calibration {

struct Motion {
  Eigen::Vector3d ecef, velocity_ecef;
  double gap_s = 0.0;  // between the two positions that it is from; 0 at one of them
};

// On the chord between the two positions around the instant, an instant of a position with the one
// after it; beyond the ends along the last chord. Two positions at least.
Motion motion_at(const Trajectory& trajectory, double utime_us);

// Without a position for so long a drone or an aircraft may be anywhere.
inline constexpr double kLongestGap_s = 3.0;

}  // namespace ols::calibration
