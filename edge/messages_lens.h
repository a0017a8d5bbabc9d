// Translation between the lens' types and the LCM messages, without any decision.
#pragma once

#include "edge/station_types.h"
#include "ols_msg/lens_command_t.hpp"
#include "ols_msg/station_status_t.hpp"

namespace ols::station {

LensCommand from_message(const ols_msg::lens_command_t& message, double now_s);
// What a status says of the lens; NaN for what is not known.
void fill_lens(const StationSnapshot& snapshot, ols_msg::station_status_t& message);

}  // namespace ols::station
