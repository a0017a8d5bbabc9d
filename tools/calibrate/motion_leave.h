// Decides from a station's status whether a procedure may move the unit or release the station from
// manual operation. Pure.
//
// A procedure's commands to point and to release end a stop, as an operator's own commands do. But
// a procedure must never end a person's stop. A status that shows no stop may have been sent just
// before a stop. After a stop, the station therefore refuses both commands for
// StationMode::kStopHold_s. If such a stop has happened, a command that relies on a status younger
// than kReliedOn_s arrives within that time and is refused.
#pragma once

#include "ols_msg/station_status_t.hpp"

namespace ols::calibration {

// [s] Max age of a usable status: kStopHold_s minus the travel time of a command.
inline constexpr double kReliedOn_s = 0.8;

// `age_s`: since the status arrived at this host.
bool may_point(const ols_msg::station_status_t& status, double age_s);
// A procedure may release only the manual operation that it has begun itself (manual_hold.h).
bool may_release(const ols_msg::station_status_t& status, double age_s);

}  // namespace ols::calibration
