#include <gtest/gtest.h>

#include "central/app/fusion_conflict_monitor.h"
#include "central/app/timeliness_gate.h"

namespace ols::fusion {
namespace {

TEST(FusionConflictMonitor, HearsAnyOneButItself) {
  FusionConflictMonitor others(7);
  EXPECT_FALSE(others.hear(7, 1.0));
  EXPECT_EQ(others.alarm(1.0), "");
  EXPECT_TRUE(others.hear(8, 2.0));
  EXPECT_TRUE(others.take_event());
  EXPECT_TRUE(others.hear(8, 3.0));
  EXPECT_FALSE(others.take_event()) << "once";
  EXPECT_NE(others.alarm(4.0), "");
  EXPECT_EQ(others.alarm(9.0), "") << "it has been ended";
}

constexpr std::int64_t kStart = 1'700'000'000'000'000;

TEST(TimelinessGate, WithholdsWhatIsFarFromTheHostsClockAndSaysSoForAWhile) {
  TimelinessGate watch(2.0);
  EXPECT_TRUE(watch.passes(kStart, kStart + 1'900'000, 10.0, 0.0));
  EXPECT_TRUE(watch.passes(kStart, kStart - 1'900'000, 10.0, 0.0));
  EXPECT_EQ(watch.alarm(10.0), "");
  EXPECT_FALSE(watch.take_event());
  EXPECT_FALSE(watch.passes(kStart, kStart + 10'000'000, 10.0, 0.0));
  EXPECT_TRUE(watch.take_event());
  EXPECT_FALSE(watch.passes(kStart, kStart + 9'900'000, 10.1, 0.0));
  EXPECT_FALSE(watch.take_event()) << "once";
  EXPECT_NE(watch.alarm(11.0).text.find("-9.9 s from this host's clock"), std::string::npos);
  EXPECT_TRUE(watch.passes(kStart, kStart, 11.0, 0.0));
  EXPECT_EQ(watch.alarm(20.0), "");
  EXPECT_FALSE(watch.passes(kStart, kStart - 3'000'000, 21.0, 0.0)) << "from the future as well";
  EXPECT_TRUE(watch.take_event());
}

// Under SIGSTOP or in a suspended host nothing is received, so that nothing has waited either.
TEST(TimelinessGate, NamesOverloadWhereTheMessagesWaitedHere) {
  TimelinessGate watch(2.0);
  EXPECT_FALSE(watch.passes(kStart, kStart + 2'300'000, 10.0, 2.1));
  EXPECT_NE(watch.alarm(10.0).text.find("overload: messages wait 2.1 s"), std::string::npos);
  EXPECT_EQ(watch.alarm(10.0).text.find("--replay"), std::string::npos);
  EXPECT_FALSE(watch.passes(kStart, kStart + 10'000'000, 11.0, 0.3));
  EXPECT_NE(watch.alarm(11.0).text.find("--replay"), std::string::npos);
}

}  // namespace
}  // namespace ols::fusion
