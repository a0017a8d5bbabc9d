// What a unit reports after carrying out an order: it is at rest at whole counts. The result has no
// picture.
#pragma once

#include <cmath>

#include "calibration/procedure/stage.h"
#include "geometry/angles.h"

namespace ols::calibration::test {

inline Taken stopped(const Shot& shot, std::int64_t pose, std::int64_t utime_us) {
  const double counts = 112000.0 / (2.0 * kPi);
  Taken taken;
  taken.pose = pose;
  taken.utime_us = utime_us;
  taken.angles = shot.angles;
  taken.reading.pan = {std::round(shot.angles.pan_rad * counts), 0.0, shot.approach_pan};
  taken.reading.tilt = {std::round(shot.angles.tilt_rad * counts), 0.0, shot.approach_tilt};
  return taken;
}

}  // namespace ols::calibration::test
