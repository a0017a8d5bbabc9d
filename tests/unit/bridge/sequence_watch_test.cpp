#include "bridge/sequence_watch.h"

#include <gtest/gtest.h>

#include <limits>

namespace ols::bridge {
namespace {

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

}  // namespace
}  // namespace ols::bridge
