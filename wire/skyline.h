// Checks a sector of a station's seen skyline, for all programs.
#pragma once

#include "ols_msg/skyline_t.hpp"

namespace ols::wire {

inline constexpr int kSkylineSectors = 72, kSkylineSectorColumns = 100;

// Whether the values are possible: no more columns than a sector has, all of this sector, in
// ascending order, with plausible numbers.
bool is_skyline(const ols_msg::skyline_t& message);

}  // namespace ols::wire
