// A unit that has carried out an order: it stands at whole counts. The picture is still missing.
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
