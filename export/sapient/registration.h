// The registration, the first message to a SAPIENT receiver. It describes in detail what the node
// sends. Pure.
#pragma once

#include <cstdint>
#include <string>

#include "export/sapient/sapient_node.h"

namespace ols::exports {

// The framed message. The receiver answers it with an acknowledgement.
std::string sapient_registration(const SapientSettings& settings, std::int64_t utime_us);

}  // namespace ols::exports
