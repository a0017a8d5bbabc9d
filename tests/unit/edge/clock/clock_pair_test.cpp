#include "edge/clock/clock_pair.h"

#include <gtest/gtest.h>

#include <optional>

#include "base/process/clocks.h"
#include "edge/clock/clock_source.h"
#include "tests/unit/eventually.h"

namespace ols::clock {
namespace {

TEST(ClockPair, IsOfOneInstant) {
  const double before = 1e-6 * static_cast<double>(clock_utime_us()) - clock_monotonic_s();
  const ClockPair pair = read_clock_pair();
  EXPECT_NEAR(1e-6 * static_cast<double>(pair.utime_us) - pair.monotonic_s, before, 1.0);
}

// The next reading.
ClockReading next(ClockSource& source) {
  std::optional<ClockReading> reading;
  EXPECT_TRUE(eventually([&] { return (reading = source.take()).has_value(); })) << "no reading";
  return reading.value_or(ClockReading{});
}

TEST(ClockSource, TellsOfChronyWhenItAnswers) {
  ClockSource source(0.01, {"echo",
                            "50505300,PPS,1,1713528723.5,-0.000000072,0,0,0,0,0,0.0,0.00001,"
                            "16.0,Normal"});
  const double before_s = clock_monotonic_s();
  next(source);
  const ClockReading reading = next(source);
  EXPECT_TRUE(reading.synchronised);
  EXPECT_EQ(reading.source, "chrony: PPS");
  EXPECT_GE(reading.monotonic_s, before_s);
  EXPECT_LE(reading.monotonic_s, clock_monotonic_s());
  EXPECT_NE(reading.utime_us, 0);
}

TEST(ClockSource, IsContentWithoutChrony) {
  ClockSource source(0.01, {"ols-no-such-program"});
  const ClockReading reading = next(source);
  EXPECT_NE(reading.source.substr(0, 6), "chrony");
  // What this machine's kernel says is not ours to know; only that it is consistent.
  EXPECT_TRUE(reading.service || !reading.synchronised);
}

TEST(ClockSource, DoesWithoutAChronyThatHangs) {
  ClockSource source(0.01, {"sleep", "1000"});
  EXPECT_NE(next(source).source.substr(0, 6), "chrony");
}

}  // namespace
}  // namespace ols::clock
