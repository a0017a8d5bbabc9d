// What a sighting tells of counts and pixel, as an LCM message; without any decision.
#pragma once

#include "edge/sighting_desk.h"
#include "ols_msg/sighting_t.hpp"

namespace ols::station {

// All but who sends it, when, and how its clock is kept.
void fill_sighting(const Sighting& sighting, ols_msg::sighting_t& message);

}  // namespace ols::station
