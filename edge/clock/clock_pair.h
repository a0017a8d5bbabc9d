// UTC and the monotonic clock at one instant.
#pragma once

#include <cstdint>

namespace ols::clock {

struct ClockPair {
  double monotonic_s = 0.0;
  std::int64_t utime_us = 0;
};

// Reads again if the process was interrupted between the two readings, because that would look like
// a step of the clock.
ClockPair read_clock_pair();

}  // namespace ols::clock
