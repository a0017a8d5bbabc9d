#include <gtest/gtest.h>

#include <limits>

#include "bridge/channel_rate_limits.h"
#include "bridge/epoch_fence.h"
#include "bridge/sequence_watch.h"

namespace ols::bridge {
namespace {

TEST(EpochFence, OfOneTargetOnlyTheGreatestIsObeyed) {
  EpochFence fence;
  EXPECT_TRUE(fence.passes("alfa", {"t", "a", 5}, 0.0));
  EXPECT_TRUE(fence.passes("alfa", {"t", "b", 6}, 0.1));
  EXPECT_FALSE(fence.passes("alfa", {"t", "a", 5}, 0.2));
  EXPECT_FALSE(fence.passes("alfa", {"t", "b", 5}, 0.3));
  EXPECT_FALSE(fence.passes("alfa", {"t", "a", 5}, 60.0));
  EXPECT_TRUE(fence.passes("alfa", {"t", "b", 6}, 60.0));
}

TEST(EpochFence, WhatIsSilentForAMinuteIsForgotten) {
  EpochFence fence;
  EXPECT_TRUE(fence.passes("alfa", {"t", "a", 1'000'000}, 0.0));
  // The store was made anew.
  EXPECT_FALSE(fence.passes("alfa", {"t", "b", 7}, 59.0));
  EXPECT_TRUE(fence.passes("alfa", {"t", "b", 7}, 60.1));
}

TEST(EpochFence, AnotherTargetsLowerEpochWaitsUntilTheGreatestIsSilent) {
  EpochFence fence;
  EXPECT_TRUE(fence.passes("alfa", {"new", "a", 9}, 0.0));
  EXPECT_FALSE(fence.passes("alfa", {"old", "b", 4}, EpochFence::kSilence_s));
  EXPECT_FALSE(fence.passes("alfa", {"old", "", 4}, EpochFence::kSilence_s)) << "it does not say";
  EXPECT_TRUE(fence.passes("bravo", {"old", "b", 4}, 0.1)) << "each station has its own";
  EXPECT_TRUE(fence.passes("alfa", {"old", "b", 4}, EpochFence::kSilence_s + 0.1));
  EXPECT_TRUE(fence.passes("alfa", {"new", "a", 9}, EpochFence::kSilence_s + 0.2));
}

TEST(EpochFence, AnOwnerLeadsToAnOlderTargetOfItsOwnAtOnce) {
  EpochFence fence;
  EXPECT_TRUE(fence.passes("alfa", {"old", "a", 4}, 0.0));
  EXPECT_TRUE(fence.passes("alfa", {"new", "a", 9}, 0.1));
  EXPECT_TRUE(fence.passes("alfa", {"old", "a", 4}, 0.2));
  EXPECT_TRUE(fence.passes("alfa", {"old", "b", 12}, 0.3));
  EXPECT_FALSE(fence.passes("alfa", {"old", "a", 4}, 0.4)) << "it is another's now";
  EXPECT_FALSE(fence.passes("alfa", {"new", "a", 9}, 0.5)) << "and that one leads the station";
}

TEST(EpochFence, TheGreatestIsThatOfWhatPassed) {
  EpochFence fence;
  EXPECT_EQ(fence.greatest(), 0U);
  EXPECT_TRUE(fence.passes("alfa", {"new", "a", 9}, 0.0));
  EXPECT_TRUE(fence.passes("bravo", {"old", "b", 4}, 0.1));
  EXPECT_FALSE(fence.passes("alfa", {"new", "a", 8}, 0.2));
  EXPECT_EQ(fence.greatest(), 9U);
}

TEST(EpochFence, WhoOwnsNothingWaitsForOwners) {
  EpochFence fence;
  EXPECT_TRUE(fence.passes("alfa", {""}, 0.0));
  EXPECT_TRUE(fence.passes("alfa", {"t", "a", 1}, 0.1));
  EXPECT_FALSE(fence.passes("alfa", {""}, 0.2));
  EXPECT_TRUE(fence.passes("alfa", {""}, 0.2 + EpochFence::kSilence_s));
}

TEST(EpochFence, AnEpochThatNoStoreCanHaveRulesNobody) {
  EpochFence fence;
  constexpr std::uint64_t kLast = std::numeric_limits<std::uint64_t>::max();
  EXPECT_FALSE(fence.passes("alfa", {"t", "x", kLast}, 0.0));
  EXPECT_TRUE(fence.passes("alfa", {"t", "a", 500}, 0.1));
  EXPECT_FALSE(fence.passes("alfa", {"t", "x", 500 + 2 * EpochFence::kMostJump}, 0.2));
  EXPECT_TRUE(fence.passes("alfa", {"t", "a", 500}, 0.3));
  EXPECT_TRUE(fence.passes("alfa", {"t", "a", 900'000}, 0.4)) << "of many targets";
  EXPECT_TRUE(fence.passes("alfa", {"t", "a", 30'000'000}, 3600.0)) << "heard of an hour later";
}

TEST(EpochFence, ManyTargetsAreForgottenFromTheOldest) {
  EpochFence fence;
  for (std::uint64_t epoch = 1; epoch <= 1002; ++epoch) {
    const std::string target = std::string("t").append(std::to_string(epoch));
    EXPECT_TRUE(fence.passes("alfa", {target, "a", epoch}, 0.0));
  }
  EXPECT_FALSE(fence.passes("alfa", {"t1002", "a", 1001}, 10.0)) << "the newest are kept";
}

TEST(EpochFence, ManyStationsAreForgottenWhenTheyAreSilent) {
  EpochFence fence;
  int passed = 0;
  for (int i = 0; i < 5000; ++i) {
    const std::string station = std::string("n").append(std::to_string(i));
    passed += fence.passes(station, {"t", "a", 5}, 0.0) ? 1 : 0;
  }
  EXPECT_EQ(passed, 2000);
  EXPECT_FALSE(fence.passes("alfa", {"t", "a", 5}, 2.0));
  EXPECT_TRUE(fence.passes("alfa", {"t", "a", 5}, 61.0));
}

TEST(SequenceWatch, AGapIsCountedAndNamedForAWhile) {
  SequenceWatch watch;
  watch.hear("alfa", 1, 10, 0.0);
  watch.hear("alfa", 1, 11, 0.1);
  EXPECT_EQ(watch.missing(), 0U);
  EXPECT_EQ(watch.alarm(0.1), "");
  watch.hear("alfa", 1, 15, 0.2);
  EXPECT_EQ(watch.missing(), 3U);
  EXPECT_EQ(watch.alarm(0.2), "alfa");
  EXPECT_EQ(watch.alarm(0.3 + SequenceWatch::kAlarm_s), "");
}

TEST(SequenceWatch, OneThatCameLateIsNotMissing) {
  SequenceWatch watch;
  for (const int sequence : {1, 2, 5, 4}) watch.hear("alfa", 1, sequence, 0.0);
  EXPECT_EQ(watch.missing(), 1U);
  EXPECT_EQ(watch.repeated(), 0U);
  watch.hear("alfa", 1, 4, 0.0);
  EXPECT_EQ(watch.repeated(), 1U);
  EXPECT_EQ(watch.missing(), 1U);
}

TEST(SequenceWatch, WhatWasBeforeTheFirstIsNotMissed) {
  SequenceWatch watch;
  watch.hear("bravo", 1, 1, 0.0);
  watch.hear("bravo", 1, 3, 0.0);
  watch.hear("alfa", 1, 10, 0.0);
  watch.hear("alfa", 1, 9, 0.0);
  EXPECT_EQ(watch.missing(), 1U);
}

TEST(SequenceWatch, ARestartIsNoGap) {
  SequenceWatch watch;
  watch.hear("alfa", 1, 1000, 0.0);
  watch.hear("alfa", 2, 1, 0.1);
  watch.hear("alfa", 2, 2, 0.2);
  watch.hear("alfa (status)", 2, 77, 0.2);
  EXPECT_EQ(watch.missing(), 0U);
}

TEST(SequenceWatch, NonsenseIsNoGap) {
  SequenceWatch watch;
  for (const std::int64_t sequence : {std::int64_t{1}, std::numeric_limits<std::int64_t>::max(),
                                      std::numeric_limits<std::int64_t>::min(), std::int64_t{0}}) {
    watch.hear("alfa", 1, sequence, 0.0);
  }
  EXPECT_EQ(watch.missing(), 0U);
}

constexpr double kRate_hz = 2.0, kFrom_s = 100.0;

TEST(ChannelRateLimits, EachChannelHasItsOwnRate) {
  ChannelRateLimits limits(10);
  int passed = 0;
  for (int i = 0; i < 100; ++i) passed += limits.passes("alfa", kRate_hz, kFrom_s) ? 1 : 0;
  EXPECT_GE(passed, 1);
  EXPECT_LT(passed, 100);
  EXPECT_TRUE(limits.passes("bravo", kRate_hz, kFrom_s));
}

TEST(ChannelRateLimits, WhoIsSilentMakesRoom) {
  ChannelRateLimits limits(2);
  EXPECT_TRUE(limits.passes("alfa", kRate_hz, kFrom_s));
  EXPECT_TRUE(limits.passes("bravo", kRate_hz, kFrom_s));
  EXPECT_FALSE(limits.passes("charlie", kRate_hz, kFrom_s + 1.0)) << "full";
  EXPECT_TRUE(limits.passes("bravo", kRate_hz, kFrom_s + 50.0));
  EXPECT_TRUE(limits.passes("charlie", kRate_hz, kFrom_s + ChannelRateLimits::kSilent_s + 1.0))
      << "alfa is forgotten";
  EXPECT_FALSE(limits.passes("alfa", kRate_hz, kFrom_s + ChannelRateLimits::kSilent_s + 1.0));
}

}  // namespace
}  // namespace ols::bridge
