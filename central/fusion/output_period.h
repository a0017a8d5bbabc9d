// When the next of what is made at a rate is due.
#pragma once

#include <cstdint>
#include <optional>

namespace ols::fusion {

// A tenth of tolerance: frames of the same rate must not be missed every other time.
inline bool is_due(const std::optional<std::int64_t>& last_us, std::int64_t now_us,
                   double rate_hz) {
  return !last_us || static_cast<double>(now_us - *last_us) >= 0.9e6 / rate_hz;
}

}  // namespace ols::fusion
