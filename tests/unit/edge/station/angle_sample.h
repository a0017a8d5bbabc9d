// A unit's angles at an instant, for tests that need no other part of the sample.
#pragma once

#include "edge/mount/angle_history.h"

namespace ols::station {

inline mount::AngleSample angle_sample(double time_s, const PanTilt& angles) {
  mount::AngleSample sample;
  sample.time_s = time_s;
  sample.angles = angles;
  return sample;
}

}  // namespace ols::station
