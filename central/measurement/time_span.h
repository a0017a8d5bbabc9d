// Time spans between stamps in microseconds.
#pragma once

#include <cstdint>

namespace ols::fusion {

constexpr double seconds(std::int64_t span_us) { return static_cast<double>(span_us) * 1e-6; }

// Whether two bearings of one station are of one exposure, given that both may be of one object. A
// station converts each to UTC when it sends it, so they differ by a microsecond or two. Behind a
// rolling shutter they differ by the rows between them as well.
inline constexpr std::int64_t kExposure_us = 2'000;
constexpr bool is_one_exposure(std::int64_t a_us, std::int64_t b_us) {
  return a_us - b_us <= kExposure_us && b_us - a_us <= kExposure_us;
}

}  // namespace ols::fusion
