#include "edge/clock/clock_pair.h"

#include "base/process/clocks.h"

namespace ols::clock {

ClockPair read_clock_pair() {
  constexpr double kApart_s = 1e-3;
  constexpr int kTries = 20;
  ClockPair best;
  double best_apart_s = 1e9;
  for (int i = 0; i < kTries && best_apart_s > kApart_s; ++i) {
    const double before_s = clock_monotonic_s();
    const std::int64_t utime_us = clock_utime_us();
    const double after_s = clock_monotonic_s();
    if (after_s - before_s >= best_apart_s) continue;
    best_apart_s = after_s - before_s;
    best = {0.5 * (before_s + after_s), utime_us};
  }
  return best;
}

}  // namespace ols::clock
