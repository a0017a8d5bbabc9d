// Whether a procedure may move a station's unit or take it out of an operator's hand, by what the
// station has said of itself. Pure.
//
// Pointing and releasing end a stop, as an operator's own commands do. A person's stop must stand:
// after it the station refuses both for StationMode::kStopHold_s, so that what it said within that
// time, "not stopped", cannot have been overtaken by a stop unnoticed.
#pragma once

#include "ols_msg/station_status_t.hpp"

namespace ols::calibration {

// [s] A status is not relied on for longer: the hold of a stop, less the way of a command.
inline constexpr double kReliedOn_s = 0.8;

// `age_s`: since the status arrived at this host.
bool may_point(const ols_msg::station_status_t& status, double age_s);
// Only what a procedure itself has put in manual operation is released.
bool may_release(const ols_msg::station_status_t& status, double age_s);

}  // namespace ols::calibration
