// Writes a sighting's counts and pixel into an LCM message. Makes no decisions.
#pragma once

#include "edge/frames/sighting_desk.h"
#include "ols_msg/sighting_t.hpp"

namespace ols::station {

// Fills everything except the sender, the time and the state of the sender's clock.
void fill_sighting(const Sighting& sighting, ols_msg::sighting_t& message);

}  // namespace ols::station
