// Converts the cues in the fusion's status to the console's own values.
#pragma once

#include "console/received.h"
#include "ols_msg/fusion_status_t.hpp"

namespace ols::console {

// Returns an array, sorted by id.
Json cues_of(const ols_msg::fusion_status_t& status);

}  // namespace ols::console
