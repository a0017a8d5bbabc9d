#include "edge/command/command_gate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace ols::station {
namespace {

constexpr std::int64_t kNow_us = 1'700'000'000'000'000;

CommandGate gate(double age_s = 100.0) {
  return {{.clock_margin_s = 0.5, .lease_max_s = 10.0},
          kNow_us - static_cast<std::int64_t>(age_s * 1e6)};
}

CommandStamp stamp(double age_s, std::int64_t boot, std::int64_t sequence, double lease_s = 1.0) {
  return {kNow_us - static_cast<std::int64_t>(age_s * 1e6), boot, sequence, lease_s};
}

TEST(CommandGate, LetsAFreshCommandThroughOnce) {
  auto g = gate();
  EXPECT_EQ(g.admit(stamp(0.1, 7, 1), kNow_us), std::nullopt);
  EXPECT_EQ(g.admit(stamp(0.1, 7, 1), kNow_us), GateRefusal::kReplayed);
  EXPECT_EQ(g.admit(stamp(0.0, 7, 2), kNow_us), std::nullopt);
  EXPECT_EQ(g.admit(stamp(0.0, 7, 2), kNow_us + 1'000'000), GateRefusal::kReplayed);
}

TEST(CommandGate, RefusesStaleAndFutureBeyondTheClockMargin) {
  auto g = gate();
  EXPECT_EQ(g.admit(stamp(1.4, 7, 1), kNow_us), std::nullopt);
  EXPECT_EQ(g.admit(stamp(1.6, 7, 2), kNow_us), GateRefusal::kStale);
  EXPECT_EQ(g.admit(stamp(-0.4, 7, 3), kNow_us), std::nullopt);
  EXPECT_EQ(g.admit(stamp(-0.6, 7, 4), kNow_us), GateRefusal::kFuture);
}

TEST(CommandGate, ANewOneRefusesWhatTheOneBeforeMayHaveLetThrough) {
  auto g = gate(0.3);
  EXPECT_EQ(g.admit(stamp(0.4, 7, 1, 5.0), kNow_us), GateRefusal::kReplayed);
  EXPECT_EQ(g.admit(stamp(0.2, 7, 2, 5.0), kNow_us), std::nullopt);
}

TEST(CommandGate, AClockThatIsSetBackBarsNobody) {
  auto g = gate(-3600.0);  // begun while it was an hour fast
  EXPECT_EQ(g.admit(stamp(0.1, 7, 1), kNow_us), std::nullopt);
}

TEST(CommandGate, SendersDoNotBarEachOther) {
  auto g = gate();
  EXPECT_EQ(g.admit(stamp(0.1, 8, 1), kNow_us), std::nullopt);
  EXPECT_EQ(g.admit(stamp(0.2, 7, 101), kNow_us), std::nullopt) << "an earlier stamp";
  EXPECT_EQ(g.admit(stamp(0.0, 8, 1), kNow_us), std::nullopt) << "a sequence used by a forger";
}

// Five POINTs a second, stamped as far ahead as is let through, while an operator releases.
TEST(CommandGate, StampsFromAheadLockNobodyOut) {
  auto g = gate();
  for (int i = 0; i < 50; ++i) {
    const std::int64_t now_us = kNow_us + i * 200'000;
    EXPECT_EQ(g.admit({now_us + 450'000, 66, i, 1.0}, now_us), std::nullopt);
    EXPECT_EQ(g.admit({now_us - 20'000, 1000 + i, 1, 1.0}, now_us), std::nullopt) << i;
  }
}

// One slew with the fusion's boot id and a sequence that none can exceed.
TEST(CommandGate, NoSequenceBarsTheLaterOnes) {
  constexpr auto kLeast = std::numeric_limits<std::int64_t>::min();
  constexpr auto kMost = std::numeric_limits<std::int64_t>::max();
  for (const std::int64_t forged : {kMost, kLeast, std::int64_t{-1}, std::int64_t{0}}) {
    auto g = gate();
    EXPECT_EQ(g.admit(stamp(0.0, 7, forged), kNow_us), std::nullopt);
    for (int i = 1; i <= 100; ++i) {
      const std::int64_t now_us = kNow_us + i * 100'000;
      EXPECT_EQ(g.admit({now_us - 10'000, 7, i, 0.5}, now_us), std::nullopt) << forged;
      EXPECT_EQ(g.admit({now_us - 10'000, 7, i, 0.5}, now_us), GateRefusal::kReplayed);
    }
  }
}

TEST(CommandGate, SequencesThatAForgerHasUsedUpAreStillGood) {
  auto g = gate();
  for (int i = 1; i <= 1000; ++i) {
    EXPECT_EQ(g.admit(stamp(0.3, 7, i), kNow_us), std::nullopt);
  }
  for (int i = 1; i <= 1000; ++i) {
    EXPECT_EQ(g.admit(stamp(0.0, 7, i), kNow_us + i), std::nullopt);
  }
}

// What a flood pushes out of the memory must not bar who is in time.
TEST(CommandGate, AFloodFromAheadBarsNeitherOperatorNorFusion) {
  constexpr std::int64_t kFlood_us = 50;  // 20 000 a second
  auto g = gate();
  for (std::int64_t i = 0; i < 8 * 20'000; ++i) {
    const std::int64_t now_us = kNow_us + i * kFlood_us;
    ASSERT_EQ(g.admit({now_us + 450'000, i % 977, i, 10.0}, now_us), std::nullopt);
    if (i % 2000 != 0) continue;
    const CommandStamp late{now_us - 300'000, 5, i, 1.0};
    ASSERT_EQ(g.admit(late, now_us), std::nullopt) << i;
    ASSERT_EQ(g.admit(late, now_us), GateRefusal::kReplayed) << i;
  }
  EXPECT_LE(g.remembered(), 65536U);
}

TEST(CommandGate, WhatWasForgottenIsReplayedAllTheSame) {
  auto g = gate();
  std::vector<CommandStamp> sent;
  for (std::int64_t i = 0; i < 200'000; ++i) {
    sent.push_back({kNow_us + i, 7, i, 10.0});
    ASSERT_EQ(g.admit(sent.back(), kNow_us + i), std::nullopt);
  }
  EXPECT_LE(g.remembered(), 65536U);
  for (const CommandStamp& again : sent) {
    ASSERT_EQ(g.admit(again, kNow_us + 200'000), GateRefusal::kReplayed) << again.sequence;
  }
}

// An hour of slews takes no more memory than seven minutes of them.
TEST(CommandGate, RemembersLittleOfWhatCanNoLongerBeFresh) {
  auto g = gate();
  for (std::int64_t i = 0; i < 36'000; ++i) {
    const std::int64_t now_us = kNow_us + i * 100'000;
    ASSERT_EQ(g.admit({now_us, 7, i, 0.5}, now_us), std::nullopt);
  }
  EXPECT_EQ(g.remembered(), 4096U);
}

TEST(CommandGate, AClockSetBackByMinutesNeitherBarsNorLetsThroughAgain) {
  auto g = gate();
  std::vector<CommandStamp> sent;
  for (std::int64_t i = 0; i < 36'000; ++i) {
    const std::int64_t now_us = kNow_us + i * 100'000;
    sent.push_back({now_us - 10'000, 7, i, 0.5});
    ASSERT_EQ(g.admit(sent.back(), now_us), std::nullopt);
  }
  for (std::int64_t i = 36'000 - 3'000; i < 36'000; ++i) {  // five minutes
    const std::int64_t now_us = kNow_us + i * 100'000;
    ASSERT_EQ(g.admit(sent[static_cast<std::size_t>(i)], now_us), GateRefusal::kReplayed);
    ASSERT_EQ(g.admit({now_us - 10'000, 7, 100'000 + i, 0.5}, now_us), std::nullopt) << i;
  }
}

TEST(CommandGate, AClockSetBackByAnHourBarsNobody) {
  auto g = gate();
  const std::int64_t hour_us = 3'600'000'000;
  for (std::int64_t i = 0; i < 10'000; ++i) {
    const std::int64_t now_us = kNow_us + hour_us + i * 100'000;
    ASSERT_EQ(g.admit({now_us - 10'000, 7, i, 0.5}, now_us), std::nullopt);
  }
  for (std::int64_t i = 0; i < 10'000; ++i) {
    const std::int64_t now_us = kNow_us + i * 100'000;
    const CommandStamp one{now_us - 10'000, 7, 20'000 + i, 0.5};
    ASSERT_EQ(g.admit(one, now_us), std::nullopt) << i;
    ASSERT_EQ(g.admit(one, now_us), GateRefusal::kReplayed) << i;
  }
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

TEST(CommandGate, AClockThatWasFastBarsNobodyOnceItIsRight) {
  constexpr std::int64_t kHour_us = 3'600'000'000;
  auto g = gate();
  const CommandStamp before = stamp(0.0, 7, 1), fast{kNow_us + kHour_us, 8, 1, 1.0};
  EXPECT_EQ(g.admit(before, kNow_us), std::nullopt);
  EXPECT_EQ(g.admit(fast, kNow_us + kHour_us), std::nullopt);
  const std::int64_t back_us = kNow_us + 300'000;
  EXPECT_EQ(g.admit(before, back_us), GateRefusal::kReplayed) << "its time has come again";
  EXPECT_EQ(g.admit({back_us, 9, 1, 1.0}, back_us), std::nullopt);
  EXPECT_EQ(g.admit(fast, kNow_us + kHour_us), GateRefusal::kReplayed);
}

// Clocks that jump to and fro, old commands again and again, more than are remembered.
TEST(CommandGate, NothingPassesTwiceHoweverTheClocksJumpWithinALease) {
  std::mt19937_64 random(5);
  const auto draw = [&random](std::int64_t below) {
    return static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(below));
  };
  CommandGate g({.clock_margin_s = 0.5, .lease_max_s = 10.0, .kept = 64, .most = 512},
                kNow_us - 100'000'000);
  std::vector<CommandStamp> sent;
  std::set<std::pair<std::int64_t, std::int64_t>> passed;  // every one has a sequence of its own
  std::int64_t now_us = kNow_us;
  std::map<std::int64_t, std::int64_t> sequences;
  for (int i = 0; i < 40'000; ++i) {
    now_us = std::min(now_us + draw(20'000), kNow_us + 9'000'000);
    if (draw(200) == 0) now_us = kNow_us + draw(7'000'000);  // steps, within what a lease covers
    CommandStamp c;
    if (!sent.empty() && draw(2) == 0) {
      c = sent[static_cast<std::size_t>(draw(static_cast<std::int64_t>(sent.size())))];
    } else {
      const std::int64_t boot = draw(2) == 0 ? draw(4) : 4 + draw(2'000);
      c = {now_us - draw(400'000), boot, ++sequences[boot], 10.0};
      sent.push_back(c);
    }
    if (g.admit(c, now_us)) continue;
    EXPECT_TRUE(passed.emplace(c.boot_id, c.sequence).second) << i;
  }
  EXPECT_GT(passed.size(), 500U);
}

}  // namespace
}  // namespace ols::station
