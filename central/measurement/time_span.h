// Conversion of time spans between microseconds and seconds.
#pragma once

#include <cstdint>

namespace ols::fusion {

constexpr double seconds(std::int64_t span_us) { return static_cast<double>(span_us) * 1e-6; }

}  // namespace ols::fusion
