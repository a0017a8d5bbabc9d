// Converts between the lens's types and LCM messages.
#pragma once

#include "edge/station/station_types.h"
#include "ols_msg/lens_command_t.hpp"
#include "ols_msg/station_status_t.hpp"

namespace ols::station {

LensCommand from_message(const ols_msg::lens_command_t& message, double now_s);
// Fills the lens's part of a status message; NaN for unknown values.
void fill_lens(const StationSnapshot& snapshot, ols_msg::station_status_t& message);

}  // namespace ols::station
