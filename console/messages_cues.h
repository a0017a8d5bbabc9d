// The cues of a fusion's status as the console's own values.
#pragma once

#include "base/bus_inbox.h"
#include "console/heard.h"

namespace ols::console {

// An array, in the order of ids; empty for what is no fusion's status.
Json cues_of(const BusMessage& message);

}  // namespace ols::console
