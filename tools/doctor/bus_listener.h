// Listens on the bus for a while.
#pragma once

#include <string>

#include "base/trust/trust_config.h"
#include "tools/doctor/facts.h"

namespace ols::doctor {

// Never throws: the result holds the error. The station `own` is reported whenever it is heard,
// even among many forged stations. A process without a trust list first waits for one.
BusFacts listen(const std::string& lcm_url, const trust::TrustConfig& trust, double seconds,
                const std::string& own = "");

}  // namespace ols::doctor
