// Compares the size of a count that a unit reports with that of a calibration. Pure.
#pragma once

#include "geometry/station_model.h"

namespace ols::station {

// [rad], exact.
double count_of(const AxisModel& axis);
// Whether a printed size of a count [rad] matches an axis with so many counts per turn: the step
// mode is then the calibrated one.
bool is_count_of(const AxisModel& axis, double printed_rad);

}  // namespace ols::station
