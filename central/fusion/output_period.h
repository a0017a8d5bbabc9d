// Whether the next periodic output is due.
#pragma once

#include <cstdint>
#include <optional>

namespace ols::fusion {

// A tolerance of a tenth of the period keeps frames at the same rate from missing every other
// period.
inline bool is_due(const std::optional<std::int64_t>& last_us, std::int64_t now_us,
                   double rate_hz) {
  return !last_us || static_cast<double>(now_us - *last_us) >= 0.9e6 / rate_hz;
}

}  // namespace ols::fusion
