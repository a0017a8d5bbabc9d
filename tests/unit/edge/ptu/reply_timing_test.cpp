#include "edge/ptu/reply_timing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/edge/ptu/unit_replies.h"

namespace ols::ptu {
namespace {

constexpr double kByte_s = 1e-3, kLatency_s = 4e-3;

TEST(ReplyTiming, AnUndelayedReplyIsReadBetweenItsQueryAndItsStart) {
  const ReplyTiming timing(kByte_s, kLatency_s);
  const PtuReading reading = timing.read_at(reply("-5", 0.011, 0.015), 0.004, 0.0, true);
  EXPECT_EQ(reading.counts, -5);
  EXPECT_NEAR(reading.time_s, 0.007, 1e-12);  // it started at 10 ms
  EXPECT_NEAR(reading.half_s, 0.003, 1e-12);
  EXPECT_NEAR(reading.time_sd_s, 0.003 / std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(timing.latency_s(reply("-5", 0.011, 0.015), 0.004), 0.006, 1e-12);
}

TEST(ReplyTiming, TheUnitIsBusyWithTheCommandBefore) {
  ReplyTiming timing(kByte_s, kLatency_s);
  timing.follow(reply("", 0.011, 0.013), 0.004, 0.0);
  // Asked at 6 ms, when the unit was busy until 10 ms; the reply starts long after the last one.
  const PtuReading reading = timing.read_at(reply("7", 0.021, 0.024), 0.006, 0.0, false);
  EXPECT_NEAR(reading.time_s, 0.015, 1e-12);
  EXPECT_NEAR(reading.half_s, 0.005, 1e-12);
}

// A reply that starts where the last one ends says nothing of when its counter was read.
TEST(ReplyTiming, AReplyThatHadToWaitIsDatedByTheUsualLatency) {
  ReplyTiming timing(kByte_s, kLatency_s);
  timing.follow(reply("", 0.011, 0.030), 0.004, 0.0);
  const PtuReading reading = timing.read_at(reply("7", 0.0315, 0.034), 0.012, 0.0, false);
  EXPECT_NEAR(reading.time_s, 0.012 + 0.5 * kLatency_s, 1e-12);
  EXPECT_NEAR(reading.time_s + reading.half_s, 0.0305 + (reading.half_s - (0.0305 - 0.014)), 1e-12);
  EXPECT_GT(reading.half_s, 0.0305 - 0.014 - 1e-12);  // the true instant is within
}

TEST(ReplyTiming, BytesReadLateWidenTheInterval) {
  const auto half_s = [](double late_s) {
    ReplyTiming timing(kByte_s, kLatency_s);
    timing.follow(reply("", 0.011, 0.013), 0.004, late_s);
    return timing.read_at(reply("7", 0.050, 0.053), 0.006, late_s, false).half_s;
  };
  EXPECT_NEAR(half_s(0.003) - half_s(0.0), 0.0015, 1e-12);
}

}  // namespace
}  // namespace ols::ptu
