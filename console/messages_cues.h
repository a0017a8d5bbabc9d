// The cues of a fusion's status as the console's own values.
#pragma once

#include "base/bus_inbox.h"
#include "console/heard.h"

namespace ols::console {

// An array, in the order of ids; empty if it is no fusion status.
Json cues_of(const BusMessage& message);

}  // namespace ols::console
