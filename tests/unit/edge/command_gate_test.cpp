#include "edge/command_gate.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

namespace ols {
namespace {

constexpr std::int64_t kNow_us = 1'700'000'000'000'000;

CommandGate gate() { return CommandGate({.clock_margin_s = 0.5, .lease_max_s = 10.0}); }

CommandStamp stamp(double age_s, std::int64_t boot, std::int64_t sequence, double lease_s = 1.0) {
  return {kNow_us - static_cast<std::int64_t>(age_s * 1e6), boot, sequence, lease_s};
}

TEST(CommandGate, LetsAFreshCommandThroughOnce) {
  auto g = gate();
  EXPECT_EQ(g.admit(stamp(0.1, 7, 1), kNow_us), std::nullopt);
  EXPECT_EQ(g.admit(stamp(0.1, 7, 1), kNow_us), GateRefusal::kReplayed);
  EXPECT_EQ(g.admit(stamp(0.0, 7, 2), kNow_us), std::nullopt);
  EXPECT_EQ(g.admit(stamp(0.0, 7, 1), kNow_us), GateRefusal::kReplayed);
}

TEST(CommandGate, RefusesStaleAndFutureBeyondTheClockMargin) {
  auto g = gate();
  EXPECT_EQ(g.admit(stamp(1.4, 7, 1), kNow_us), std::nullopt);
  EXPECT_EQ(g.admit(stamp(1.6, 7, 2), kNow_us), GateRefusal::kStale);
  EXPECT_EQ(g.admit(stamp(-0.4, 7, 3), kNow_us), std::nullopt);
  EXPECT_EQ(g.admit(stamp(-0.6, 7, 4), kNow_us), GateRefusal::kFuture);
}

TEST(CommandGate, ARestartedSenderCountsOnlyWhenItIsTheLaterOne) {
  auto g = gate();
  EXPECT_EQ(g.admit(stamp(0.2, 7, 100), kNow_us), std::nullopt);
  EXPECT_EQ(g.admit(stamp(0.1, 8, 1), kNow_us), std::nullopt);
  EXPECT_EQ(g.admit(stamp(0.2, 7, 101), kNow_us), GateRefusal::kReplayed);
}

TEST(CommandGate, RefusesALeaseThatIsNone) {
  auto g = gate();
  for (const double lease_s : {0.0, -1.0, 11.0, std::numeric_limits<double>::quiet_NaN(),
                               std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(g.admit(stamp(0.0, 7, 1, lease_s), kNow_us), GateRefusal::kLease) << lease_s;
  }
}

TEST(CommandGate, SurvivesAbsurdStamps) {
  auto g = gate();
  const auto least = std::numeric_limits<std::int64_t>::min();
  const auto most = std::numeric_limits<std::int64_t>::max();
  EXPECT_EQ(g.admit({least, 7, 1, 1.0}, kNow_us), GateRefusal::kStale);
  EXPECT_EQ(g.admit({most, 7, 1, 1.0}, kNow_us), GateRefusal::kFuture);
}

TEST(CommandGate, ARefusedCommandIsNotRemembered) {
  auto g = gate();
  EXPECT_EQ(g.admit(stamp(9.0, 7, 50), kNow_us), GateRefusal::kStale);
  EXPECT_EQ(g.admit(stamp(0.0, 7, 1), kNow_us), std::nullopt);
}

}  // namespace
}  // namespace ols
