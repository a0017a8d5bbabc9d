// Converts what a status says about a station's calibration to the console's values. The status is
// the station's own, or the fusion's.
#pragma once

#include "console/received.h"
#include "ols_msg/fusion_status_t.hpp"
#include "ols_msg/station_status_t.hpp"

namespace ols::console {

// Returns {state, id, utime_us, sd_deg}. state: "none", "in use", "refused" or "doubted". utime_us:
// time of the calibration's last observation; null if not stated. sd_deg: 1-sigma of a direction,
// each axis; null if there is none.
Json calibration_of(const ols_msg::station_status_t& status);
// The same without the id, from the fusion's report on a station. `station`: the station's index in
// the status.
Json calibration_of(const ols_msg::fusion_status_t& status, std::size_t station);

}  // namespace ols::console
