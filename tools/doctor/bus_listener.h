// Listens on the bus for a while.
#pragma once

#include <string>

#include "base/trust/trust_config.h"
#include "tools/doctor/facts.h"

namespace ols::doctor {

// Listens for `seconds`. Never throws: the result contains the error. The station `own` is always
// reported if its status arrives, even among many forged stations. If there is no trust list yet,
// first waits for one.
BusFacts listen(const std::string& lcm_url, const trust::TrustConfig& trust, double seconds,
                const std::string& own = "");

}  // namespace ols::doctor
