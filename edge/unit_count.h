// Compares the size of a count that a unit reports with that of a calibration. Pure.
#pragma once

#include "geometry/station_model.h"

namespace ols::station {

// [rad], exactly.
double count_of(const AxisModel& axis);
// Whether a count that the unit printed [rad] is of an axis with so many to a turn: its step mode
// is the one that it was calibrated in.
bool is_count_of(const AxisModel& axis, double printed_rad);

}  // namespace ols::station
