// Functions for the benchmarks that run under load.
#pragma once

#include <algorithm>
#include <cmath>
#include <ctime>
#include <vector>

#include "base/process/clocks.h"

namespace ols::bench {

// Calls `act` with 0, 1, … at a constant rate. If this process was suspended, the calls that became
// due in the meantime follow immediately.
void at_rate(double rate_hz, double seconds, const auto& act) {
  // A short nap: only a few messages of a flood become due during it.
  constexpr timespec kNap{0, 200'000};
  const double begin_s = clock_monotonic_s();
  const auto total = static_cast<std::size_t>(std::llround(rate_hz * seconds));
  for (std::size_t turn = 0; turn < total;) {
    const double passed_s = clock_monotonic_s() - begin_s;
    const auto due = std::min(total, static_cast<std::size_t>(passed_s * rate_hz) + 1);
    while (turn < due) act(turn++);
    ::nanosleep(&kNap, nullptr);
  }
}

// The quantile of the values for this share (0.5: the median); NaN if there are no values.
inline double quantile(std::vector<double> values, double share) {
  if (values.empty()) return NAN;
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, values.begin() + at);
  return values[static_cast<std::size_t>(at)];
}

}  // namespace ols::bench
