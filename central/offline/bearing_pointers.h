// Pointers to the bearings of a recording. Each bearing is in memory only once, although several
// lists contain it in different orders.
#pragma once

#include <vector>

#include "central/measurement/bearing_measurement.h"

namespace ols::fusion {

using BearingPointers = std::vector<const BearingMeasurement*>;
using MutableBearings = std::vector<BearingMeasurement*>;

inline BearingPointers pointers_to(const std::vector<BearingMeasurement>& measurements) {
  BearingPointers pointers;
  pointers.reserve(measurements.size());
  for (const BearingMeasurement& measurement : measurements) pointers.push_back(&measurement);
  return pointers;
}

}  // namespace ols::fusion
