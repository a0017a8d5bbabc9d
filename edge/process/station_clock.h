// The clocks of a station's process, read at the same instant, and the quality of its UTC.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "edge/clock/clock_pair.h"
#include "edge/clock/clock_watch.h"

namespace ols::station {

// Returns the newest reading of a time service since the last call.
using TimeService = std::function<std::optional<clock::ClockReading>()>;
// Kernel and chrony of this host, queried every few seconds.
TimeService host_time_service();

class StationClock {
 public:
  StationClock(const clock::ClockWatch::Config& config, TimeService service)
      : watch_(config), service_(std::move(service)) {}

  // Call in every turn, before anything is published.
  clock::ClockPair look();
  clock::ClockQuality quality(double now_s) const { return watch_.quality(now_s); }
  // Converts with the clocks of the last look().
  std::int64_t utime_us(double monotonic_s) const;

 private:
  clock::ClockWatch watch_;
  TimeService service_;
  std::int64_t utc_minus_monotonic_us_ = 0;
};

}  // namespace ols::station
