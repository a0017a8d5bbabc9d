#include "edge/process/station_clock.h"

#include <gtest/gtest.h>

#include "base/process/clocks.h"

namespace ols::station {
namespace {

TEST(StationClock, GivesTheUtcOfAMonotonicInstant) {
  StationClock clock({}, [] { return std::nullopt; });
  const std::int64_t before_us = clock_utime_us();
  const clock::ClockPair now = clock.look();
  const std::int64_t after_us = clock_utime_us();
  const std::int64_t utime_us = clock.utime_us(now.monotonic_s);
  EXPECT_LE(before_us - 1, utime_us);
  EXPECT_GE(after_us + 1, utime_us);
  EXPECT_NEAR(static_cast<double>(clock.utime_us(now.monotonic_s - 2.5) - utime_us), -2.5e6, 1.0);
}

}  // namespace
}  // namespace ols::station
