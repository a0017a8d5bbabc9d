#include "central/filter/consecutive_rejections.h"

#include <gtest/gtest.h>

namespace ols::fusion {
namespace {

TEST(ConsecutiveRejections, OfTwoStationsSayThatTheTargetHasManoeuvred) {
  ConsecutiveRejections row;
  for (int i = 1; i < ConsecutiveRejections::kMany; ++i) {
    EXPECT_FALSE(row.add(i % 2 == 0 ? "a" : "b")) << i;
  }
  EXPECT_TRUE(row.add("a"));
}

TEST(ConsecutiveRejections, OfOneStationSayNothing) {
  ConsecutiveRejections row;
  for (int i = 0; i < 50; ++i) EXPECT_FALSE(row.add("a")) << i;
  EXPECT_TRUE(row.add("b"));
}

TEST(ConsecutiveRejections, OneUsedBearingEndsTheRow) {
  ConsecutiveRejections row;
  for (int i = 0; i < 5; ++i) row.add(i % 2 == 0 ? "a" : "b");
  row.clear();
  EXPECT_FALSE(row.add("a"));
}

}  // namespace
}  // namespace ols::fusion
