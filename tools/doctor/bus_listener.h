// Listens on the bus for a while.
#pragma once

#include <string>

#include "tools/doctor/facts.h"

namespace ols::doctor {

// Never throws: the result holds the error. `own` is reported if it is heard, however many forged
// stations there are.
BusHeard listen(const std::string& lcm_url, double seconds, const std::string& own = "");

}  // namespace ols::doctor
