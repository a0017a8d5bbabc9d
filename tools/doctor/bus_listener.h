// Listens on the bus for a while.
#pragma once

#include <string>

#include "tools/doctor/facts.h"

namespace ols::doctor {

// Never throws: what keeps it from listening is in the answer. However many stations are invented,
// `own` is among those heard when it is.
BusHeard listen(const std::string& lcm_url, double seconds, const std::string& own = "");

}  // namespace ols::doctor
