// Whether a procedure may move a station's unit, or end an operator's manual operation, judged from
// the station's status. Pure.
//
// Pointing and releasing end a stop, as an operator's own commands do. A person's stop must hold.
// After a stop, the station therefore refuses both for StationMode::kStopHold_s. A status that
// shows no stop may be older than a stop. A command that relies on a status younger than
// kReliedOn_s arrives while such a stop still holds.
#pragma once

#include "ols_msg/station_status_t.hpp"

namespace ols::calibration {

// [s] Max age of a usable status: the hold of a stop minus the travel time of a command.
inline constexpr double kReliedOn_s = 0.8;

// `age_s`: since the status arrived at this host.
bool may_point(const ols_msg::station_status_t& status, double age_s);
// Only manual operation that the procedure itself has begun may be released.
bool may_release(const ols_msg::station_status_t& status, double age_s);

}  // namespace ols::calibration
