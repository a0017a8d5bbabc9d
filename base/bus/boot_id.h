// The boot id: a number that distinguishes one run of a program from every other run on the bus.
#pragma once

#include <cstdint>

namespace ols {

// Returns a new random boot id at each call; never negative.
std::int64_t draw_boot_id();

}  // namespace ols
