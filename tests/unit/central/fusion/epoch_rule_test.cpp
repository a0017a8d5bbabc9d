#include "central/fusion/epoch_rule.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "tests/unit/central/flight.h"

namespace ols::fusion {
namespace {

using test::kStart;

constexpr std::int64_t kFrameUs = 66'000;
constexpr double kRateHz = 15.0;

std::string name(int station) { return std::string(1, static_cast<char>('a' + station)); }

// Stations that expose one after the other, some frames each; "now" is as old as it may be.
EpochRule in_turn(int stations, int frames) {
  EpochRule rule;
  for (int i = 0; i < stations * frames; ++i) {
    const std::int64_t utime_us = kStart + i * kFrameUs / stations;
    rule.hear(name(i % stations), utime_us, utime_us - (stations > 1 ? kFrameUs / 2 : 0));
  }
  return rule;
}

TEST(EpochRule, OfStationsThatExposeInTurnItIsTheNewestStamp) {
  EpochRule rule = in_turn(4, 5);
  EXPECT_EQ(rule.after(std::nullopt, kRateHz), kStart + 19 * kFrameUs / 4);
}

TEST(EpochRule, ThereIsOnePerPeriod) {
  EpochRule rule = in_turn(4, 5);
  const std::int64_t newest_us = kStart + 19 * kFrameUs / 4;
  EXPECT_EQ(EpochRule().after(std::nullopt, kRateHz), std::nullopt);
  EXPECT_EQ(rule.after(newest_us - 50'000, kRateHz), std::nullopt);
  EXPECT_EQ(rule.after(newest_us - 61'000, kRateHz), newest_us);
}

// The bearing of the third of four is the first after which most have been heard.
TEST(EpochRule, OfStationsThatExposeTogetherMostAreHeard) {
  EpochRule rule;
  for (int frame = 0; frame < 4; ++frame) {
    for (int station = 0; station < 4; ++station) {
      // The stamps of one instant are not equal.
      const std::int64_t utime_us = kStart + frame * kFrameUs + 100 * station;
      rule.hear(name(station), utime_us, utime_us);
      if (frame < 2) continue;  // their frame intervals are not known
      const auto epoch_us = rule.after(kStart + (frame - 1) * kFrameUs + 300, kRateHz);
      EXPECT_EQ(epoch_us.has_value(), station >= 2) << frame << name(station);
      if (epoch_us) {
        EXPECT_EQ(*epoch_us, utime_us);
      }
    }
  }
}

// Two that expose together, and then one alone: its next frame is published at once.
TEST(EpochRule, OneThatMissesAFrameIsNotWaitedForAgain) {
  EpochRule rule;
  for (int frame = 0; frame < 3; ++frame) {
    rule.hear("a", kStart + frame * kFrameUs, kStart + frame * kFrameUs);
    rule.hear("b", kStart + frame * kFrameUs, kStart + frame * kFrameUs);
  }
  const std::int64_t last_us = kStart + 2 * kFrameUs;
  rule.hear("a", last_us + kFrameUs, last_us + kFrameUs);
  EXPECT_EQ(rule.after(last_us, kRateHz), std::nullopt) << "b's frame is due";
  rule.hear("a", last_us + 2 * kFrameUs, last_us + 2 * kFrameUs);
  EXPECT_EQ(rule.after(last_us + kFrameUs, kRateHz), last_us + 2 * kFrameUs);
}

// Whatever is on its way: cameras of 500 frames a second whose messages arrive out of order.
TEST(EpochRule, NoEpochWaitsForLong) {
  EpochRule rule;
  rule.hear("a", kStart, kStart);
  std::int64_t now_us = kStart;
  std::int64_t waited_us = 0;
  for (int i = 1; i < 200; ++i) {
    now_us = kStart + i * 2000;
    rule.hear("a", now_us, now_us);
    for (int k = 0; k < 6; ++k) rule.hear(name(k + 1), now_us - 6000, now_us);
    if (!rule.after(now_us - 60'000 - waited_us, kRateHz)) waited_us += 2000;
    ASSERT_LE(waited_us, 20'000);
  }
  EXPECT_EQ(waited_us, 20'000) << "the others' frames are always due";
}

// A clock that is ahead by more than a frame, or steps there, makes no epoch.
TEST(EpochRule, AWrongClockMakesNoEpoch) {
  EpochRule rule = in_turn(4, 5);
  const std::int64_t now_us = kStart + 19 * kFrameUs / 4;
  for (int frame = 1; frame < 5; ++frame)
    rule.hear("a", now_us + 300'000 + frame * kFrameUs, now_us);
  EXPECT_EQ(rule.after(std::nullopt, kRateHz), now_us);
}

TEST(EpochRule, WhoIsForgottenIsNotWaitedFor) {
  EpochRule rule;
  for (int frame = 0; frame < 3; ++frame) {
    rule.hear("a", kStart + frame * kFrameUs, kStart + frame * kFrameUs);
    if (frame < 2) rule.hear("b", kStart + frame * kFrameUs, kStart + frame * kFrameUs);
  }
  EXPECT_EQ(rule.after(kStart + kFrameUs, kRateHz), std::nullopt);
  rule.forget("b");
  EXPECT_EQ(rule.after(kStart + kFrameUs, kRateHz), kStart + 2 * kFrameUs);
  rule.clear();
  EXPECT_EQ(rule.after(std::nullopt, kRateHz), std::nullopt);
}

// The whole fusion, of stations that expose in turn: each target is as new as the bearing with
// which it is published; the paper's is of the instant that half of the stations have passed.
TEST(EpochRule, ATargetIsAsNewAsTheBearingWithWhichItComes) {
  Fusion fusion{FusionConfig{}};
  int targets = 0, papers = 0;
  for (const BearingMeasurement& measurement : test::flight(4.0)) {
    const FusionOutput output = fusion.add(measurement);
    for (const FusedTarget& target : output.targets) {
      EXPECT_EQ(target.utime_us, measurement.utime_us);
      if (target.estimate.solution != Solution::kOk) continue;
      EXPECT_LT(test::error_m(target), 0.05);
      ++targets;
    }
    for (const FusedTarget& target : output.targets_paper) {
      EXPECT_EQ(target.utime_us, fusion.now_us());
      ++papers;
    }
  }
  EXPECT_GT(targets, 45);
  EXPECT_GT(papers, 45);
}

// An estimator without memory would extrapolate.
TEST(EpochRule, WhatIsInterpolatedIsOfNow) {
  FusionConfig config;
  config.estimator = "least-squares";
  Fusion fusion{config};
  int targets = 0;
  for (const BearingMeasurement& measurement : test::flight(4.0)) {
    for (const FusedTarget& target : fusion.add(measurement).targets) {
      EXPECT_EQ(target.utime_us, fusion.now_us());
      targets += target.estimate.solution == Solution::kOk ? 1 : 0;
    }
  }
  EXPECT_GT(targets, 45);
}

}  // namespace
}  // namespace ols::fusion
