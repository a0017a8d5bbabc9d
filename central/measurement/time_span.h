// Time spans between stamps in microseconds.
#pragma once

#include <cstdint>

namespace ols::fusion {

constexpr double seconds(std::int64_t span_us) { return static_cast<double>(span_us) * 1e-6; }

// Whether two bearings of one station, possibly of one object, are of the same exposure. Their
// stamps may differ by a microsecond or two, because the station converts each stamp to UTC when it
// sends the bearing. With a rolling shutter, the stamps also differ by the time between the rows.
inline constexpr std::int64_t kExposure_us = 2'000;
constexpr bool is_one_exposure(std::int64_t a_us, std::int64_t b_us) {
  return a_us - b_us <= kExposure_us && b_us - a_us <= kExposure_us;
}

}  // namespace ols::fusion
