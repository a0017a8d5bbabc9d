// Spans of time as they are counted and as they are calculated with.
#pragma once

#include <cstdint>

namespace ols::fusion {

constexpr double seconds(std::int64_t span_us) { return static_cast<double>(span_us) * 1e-6; }

}  // namespace ols::fusion
