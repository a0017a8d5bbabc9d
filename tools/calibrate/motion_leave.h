// Decides from a station's status whether a procedure may move the unit or release the station from
// manual operation. Pure.
//
// A stop ends when a procedure or an operator commands the station to point, or releases it from
// manual operation. But a procedure must never end a person's stop. A status that shows no stop may
// have been sent just before a stop. After a stop, the station therefore refuses both commands for
// StationMode::kStopHold_s. If a stop came after the status was sent, a command that relies on a
// status younger than kReliedOn_s arrives within kStopHold_s of that stop, and is refused.
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
