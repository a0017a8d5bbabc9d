// Whether a procedure may move a station's unit, or end an operator's manual operation, judged from
// the station's status. Pure.
//
// Pointing and releasing end a stop, as an operator's own commands do. A person's stop must hold.
// After a stop, the station therefore refuses both for StationMode::kStopHold_s. A command sent on
// a younger status "not stopped" cannot undo a stop that this status does not show yet.
#pragma once

#include "ols_msg/station_status_t.hpp"

namespace ols::calibration {

// [s] Max age of a usable status: the hold of a stop minus the travel time of a command.
inline constexpr double kReliedOn_s = 0.8;

// `age_s`: since the status arrived at this host.
bool may_point(const ols_msg::station_status_t& status, double age_s);
// Only manual operation that a procedure has begun is released.
bool may_release(const ols_msg::station_status_t& status, double age_s);

}  // namespace ols::calibration
