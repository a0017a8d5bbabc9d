// What a station and the fusion say of a station's calibration, as the console's own values.
#pragma once

#include "console/heard.h"
#include "ols_msg/fusion_status_t.hpp"
#include "ols_msg/station_status_t.hpp"

namespace ols::console {

// {state, id, utime_us, sd_deg}: "none", "in use", "refused" or "doubted"; its name; its last
// observation, null if it is not stated; 1-sigma of an axis of a direction, null without one.
Json calibration_of(const ols_msg::station_status_t& status);
// The same without an id, as the fusion weighs the station at this place of its list.
Json calibration_of(const ols_msg::fusion_status_t& status, std::size_t station);

}  // namespace ols::console
