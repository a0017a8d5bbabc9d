#include <gtest/gtest.h>

#include "central/app/timeliness_gate.h"

namespace ols::fusion {
namespace {

constexpr std::int64_t kStart = 1'700'000'000'000'000;

TEST(TimelinessGate, WithholdsWhatIsFarFromTheHostsClockAndSaysSoForAWhile) {
  TimelinessGate watch(2.0);
  EXPECT_TRUE(watch.passes(kStart, kStart + 1'900'000, 10.0));
  EXPECT_TRUE(watch.passes(kStart, kStart - 1'900'000, 10.0));
  EXPECT_EQ(watch.alarm(10.0), "");
  EXPECT_FALSE(watch.take_event());
  EXPECT_FALSE(watch.passes(kStart, kStart + 10'000'000, 10.0));
  EXPECT_TRUE(watch.take_event());
  EXPECT_FALSE(watch.passes(kStart, kStart + 9'900'000, 10.1));
  EXPECT_FALSE(watch.take_event()) << "once";
  EXPECT_NE(watch.alarm(11.0).find("-9.9 s from this host's clock"), std::string::npos);
  EXPECT_TRUE(watch.passes(kStart, kStart, 11.0));
  EXPECT_EQ(watch.alarm(20.0), "");
  EXPECT_FALSE(watch.passes(kStart, kStart - 3'000'000, 21.0)) << "from the future as well";
  EXPECT_TRUE(watch.take_event());
}

}  // namespace
}  // namespace ols::fusion
