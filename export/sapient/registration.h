// The registration, which describes at length what the node sends. Pure.
#pragma once

#include <cstdint>
#include <string>

#include "export/sapient/sapient_node.h"

namespace ols::exports {

// Framed. Receivers answer it with an acknowledgement.
std::string sapient_registration(const SapientSettings& settings, std::int64_t utime_us);

}  // namespace ols::exports
