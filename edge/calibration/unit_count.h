// Compares the size of a count that a unit reports with that of a calibration. Pure.
#pragma once

#include "geometry/station_model.h"

namespace ols::station {

// [rad], exact.
double count_of(const AxisModel& axis);
// Whether the size of a count [rad] that a unit prints matches an axis with this many counts per
// turn. If so, the step mode is the calibrated one.
bool is_count_of(const AxisModel& axis, double printed_rad);

}  // namespace ols::station
