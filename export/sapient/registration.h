// The registration, which says at length what may be expected of the node. Pure.
#pragma once

#include <cstdint>
#include <string>

#include "export/sapient/sapient_node.h"

namespace ols::exports {

// Framed; receivers answer it with an acknowledgement.
std::string sapient_registration(const SapientSettings& settings, std::int64_t utime_us);

}  // namespace ols::exports
