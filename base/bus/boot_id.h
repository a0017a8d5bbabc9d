// A number that distinguishes one run of a program from another on the bus.
#pragma once

#include <cstdint>

namespace ols {

// A new random number at each call; never negative.
std::int64_t draw_boot_id();

}  // namespace ols
