// Listens on the bus for a while.
#pragma once

#include <string>

#include "base/trust/trust_config.h"
#include "tools/doctor/facts.h"

namespace ols::doctor {

// Never throws: the result holds the error. `own` is reported if it is heard, however many forged
// stations there are. Without a trust list, it waits for the first one before it listens and
// judges.
BusHeard listen(const std::string& lcm_url, const trust::TrustConfig& trust, double seconds,
                const std::string& own = "");

}  // namespace ols::doctor
