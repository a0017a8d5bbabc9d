// What a unit has reported at an instant, for the tests that need no more of it.
#pragma once

#include "edge/ptu/angle_history.h"

namespace ols::station {

inline ptu::AngleSample angle_sample(double time_s, const PanTilt& angles) {
  ptu::AngleSample sample;
  sample.time_s = time_s;
  sample.angles = angles;
  return sample;
}

}  // namespace ols::station
