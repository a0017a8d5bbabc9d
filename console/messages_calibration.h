// Converts a station's calibration, from its own status or from the fusion's, to the console's
// values.
#pragma once

#include "console/received.h"
#include "ols_msg/fusion_status_t.hpp"
#include "ols_msg/station_status_t.hpp"

namespace ols::console {

// {state, id, utime_us, sd_deg}: "none", "in use", "refused" or "doubted"; its id; its last
// observation, null if not stated; 1-sigma of a direction, each axis, null if there is none.
Json calibration_of(const ols_msg::station_status_t& status);
// The same, but without an id; from the fusion's report on the station with this index.
Json calibration_of(const ols_msg::fusion_status_t& status, std::size_t station);

}  // namespace ols::console
