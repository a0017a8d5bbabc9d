// Whether the next periodic output is due.
#pragma once

#include <cstdint>
#include <optional>

namespace ols::fusion {

// Whether at least nine tenths of a period (1 / rate_hz) have passed since the last output. Without
// this tolerance, jitter of frames at the same rate would delay every other output by a frame.
inline bool is_due(const std::optional<std::int64_t>& last_us, std::int64_t now_us,
                   double rate_hz) {
  return !last_us || static_cast<double>(now_us - *last_us) >= 0.9e6 / rate_hz;
}

}  // namespace ols::fusion
