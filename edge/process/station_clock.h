// Reads UTC and the monotonic clock of a station's process at the same instant, and judges the
// quality of UTC.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "edge/clock/clock_pair.h"
#include "edge/clock/clock_watch.h"

namespace ols::station {

// A function that returns the newest reading of the time service; nullopt if there is none since
// its last call.
using TimeService = std::function<std::optional<clock::ClockReading>()>;
// The time service of this computer: kernel and chrony, queried every few seconds.
TimeService host_time_service();

class StationClock {
 public:
  StationClock(const clock::ClockWatch::Config& config, TimeService service)
      : watch_(config), service_(std::move(service)) {}

  // Reads the clocks. Call in every cycle of the control loop, before anything is published.
  clock::ClockPair look();
  clock::ClockQuality quality(double now_s) const { return watch_.quality(now_s); }
  // Converts monotonic time to UTC, with the difference of the clocks at the last look().
  std::int64_t utime_us(double monotonic_s) const;

 private:
  clock::ClockWatch watch_;
  TimeService service_;
  std::int64_t utc_minus_monotonic_us_ = 0;
};

}  // namespace ols::station
