// CLOCK_MONOTONIC and UTC at one instant.
#pragma once

#include <cstdint>

namespace ols::clock {

struct ClockPair {
  double monotonic_s = 0.0;
  std::int64_t utime_us = 0;
};

// Reads both clocks. If the process is interrupted between the two readings, both clocks are read
// again, because the interruption would look like a step of the clock.
ClockPair read_clock_pair();

}  // namespace ols::clock
