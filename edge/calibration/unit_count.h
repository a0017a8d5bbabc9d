// Compares the size of a count that a unit reports with that of a calibration. Pure.
#pragma once

#include "geometry/station_model.h"

namespace ols::station {

// The exact size of a count [rad].
double count_of(const AxisModel& axis);
// Whether `printed_rad`, the size of a count that a unit reports, matches the number of counts per
// turn of this axis. If it does, the step mode is that of the calibration.
bool is_count_of(const AxisModel& axis, double printed_rad);

}  // namespace ols::station
