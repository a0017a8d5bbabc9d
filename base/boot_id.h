// What tells one run of a program from another on the bus.
#pragma once

#include <cstdint>

namespace ols {

// Drawn anew with each call; never negative.
std::int64_t draw_boot_id();

}  // namespace ols
