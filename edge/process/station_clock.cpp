#include "edge/process/station_clock.h"

#include <cmath>
#include <memory>

#include "edge/clock/clock_source.h"

namespace ols::station {

TimeService host_time_service() {
  return [source = std::make_shared<clock::ClockSource>()] { return source->take(); };
}

clock::ClockPair StationClock::look() {
  const clock::ClockPair now = clock::read_clock_pair();
  watch_.tick(now.monotonic_s, now.utime_us);
  if (const auto reading = service_()) watch_.add(*reading);
  utc_minus_monotonic_us_ = now.utime_us - std::llround(now.monotonic_s * 1e6);
  return now;
}

std::int64_t StationClock::utime_us(double monotonic_s) const {
  return std::llround(monotonic_s * 1e6) + utc_minus_monotonic_us_;
}

}  // namespace ols::station
