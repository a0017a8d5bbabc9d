#include "bridge/epoch_fence.h"

#include <gtest/gtest.h>

#include <limits>

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

}  // namespace
}  // namespace ols::bridge
