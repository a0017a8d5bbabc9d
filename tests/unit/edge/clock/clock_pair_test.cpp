#include "edge/clock/clock_pair.h"

#include <gtest/gtest.h>

#include "base/process/clocks.h"

namespace ols::clock {
namespace {

TEST(ClockPair, IsOfOneInstant) {
  const double before = 1e-6 * static_cast<double>(clock_utime_us()) - clock_monotonic_s();
  const ClockPair pair = read_clock_pair();
  EXPECT_NEAR(1e-6 * static_cast<double>(pair.utime_us) - pair.monotonic_s, before, 1.0);
}

}  // namespace
}  // namespace ols::clock
