// Writes a sighting, a bearing's pixel and encoder counts, into an LCM message.
#pragma once

#include "edge/frames/sighting_desk.h"
#include "ols_msg/sighting_t.hpp"

namespace ols::station {

// Fills all fields except the sender, the time and the state of the sender's clock.
void fill_sighting(const Sighting& sighting, ols_msg::sighting_t& message);

}  // namespace ols::station
