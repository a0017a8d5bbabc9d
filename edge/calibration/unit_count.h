// Compares the size of a count that a unit reports with the one in a calibration. Pure.
#pragma once

#include "geometry/station_model.h"

namespace ols::station {

// The exact size of a count [rad].
double count_of(const AxisModel& axis);
// Whether the size of a count [rad] that a unit reports matches an axis with this many counts per
// turn. If so, the step mode is the same as in the calibration.
bool is_count_of(const AxisModel& axis, double printed_rad);

}  // namespace ols::station
