#include "export/present_targets.h"

#include <gtest/gtest.h>

#include "tests/unit/export/made_records.h"

namespace ols::exports {
namespace {

Target end_of(std::int64_t id, std::int64_t after_us) {
  Target end = made_target(id, after_us);
  end.state = TrackState::kEnded;
  end.place = {kUnknown, kUnknown, kUnknown, kUnknown};
  return end;
}

TEST(PresentTargets, AnEndSaysWhereTheTargetWasLast) {
  PresentTargets targets;
  EXPECT_EQ(targets.take(made_target()).size(), 1U);
  const auto told = targets.take(end_of(7, 500'000));
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].state, TrackState::kEnded);
  EXPECT_EQ(told[0].utime_us, kNow_us + 500'000);
  EXPECT_DOUBLE_EQ(told[0].place.height_m, 100.0);
  EXPECT_TRUE(targets.take(end_of(7, 600'000)).empty());
}

TEST(PresentTargets, WhatIsSilentEnds) {
  PresentTargets targets;
  targets.take(made_target(1));
  targets.take(made_target(2, 5'000'000));
  EXPECT_TRUE(targets.end_silent(kNow_us + 10'000'000).empty());
  const auto ends = targets.end_silent(kNow_us + 10'000'001);
  ASSERT_EQ(ends.size(), 1U);
  EXPECT_EQ(ends[0].id, 1);
  EXPECT_EQ(targets.size(), 1U);
}

TEST(PresentTargets, AnOlderRecordIsNoNews) {
  PresentTargets targets;
  targets.take(made_target(1, 1000));
  EXPECT_TRUE(targets.take(made_target(1, 999)).empty());
}

TEST(PresentTargets, InventedTargetsEndTheOldest) {
  PresentTargets targets;
  for (std::size_t i = 0; i < PresentTargets::kMost; ++i) {
    targets.take(made_target(static_cast<std::int64_t>(i + 1), static_cast<std::int64_t>(i)));
  }
  const auto told = targets.take(made_target(99'999, 99'999));
  ASSERT_EQ(told.size(), 2U);
  EXPECT_EQ(told[0].id, 1);
  EXPECT_EQ(told[0].state, TrackState::kEnded);
  EXPECT_EQ(targets.size(), PresentTargets::kMost);
}

}  // namespace
}  // namespace ols::exports
