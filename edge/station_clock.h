// The clocks of a station's process, read at one instant, and the quality of its UTC.
#pragma once

#include <cstdint>

#include "edge/clock/clock_pair.h"
#include "edge/clock/clock_source.h"
#include "edge/clock/clock_watch.h"

namespace ols::station {

class StationClock {
 public:
  explicit StationClock(const clock::ClockWatch::Config& config) : watch_(config) {}

  // In every turn, before anything is published.
  clock::ClockPair look();
  clock::ClockQuality quality(double now_s) const { return watch_.quality(now_s); }
  // By the clocks of the last look().
  std::int64_t utime_us(double monotonic_s) const;

 private:
  static constexpr double kInterval_s = 5.0;  // between two queries of kernel and chrony

  clock::ClockWatch watch_;
  clock::ClockSource source_{kInterval_s};
  std::int64_t utc_minus_monotonic_us_ = 0;
};

}  // namespace ols::station
