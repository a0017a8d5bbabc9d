#include "base/trust/rate_limit.h"

#include <gtest/gtest.h>

namespace ols::trust {
namespace {

int pass(RateLimit& limit, double now_s, int tries) {
  int passed = 0;
  for (int i = 0; i < tries; ++i) {
    if (!limit.has(now_s)) continue;
    limit.spend();
    ++passed;
  }
  return passed;
}

TEST(RateLimit, ASecondsWorthAtOnceAndThenTheRate) {
  RateLimit limit(20.0);
  EXPECT_EQ(pass(limit, 100.0, 1000), 20);
  EXPECT_EQ(pass(limit, 100.0, 1000), 0);
  EXPECT_EQ(pass(limit, 100.5, 1000), 10);
  EXPECT_EQ(pass(limit, 200.0, 1000), 20) << "rest is not saved";
}

TEST(RateLimit, WhatIsNotSpentCostsNothing) {
  RateLimit limit(2.0);
  for (int i = 0; i < 10; ++i) EXPECT_TRUE(limit.has(5.0));
}

TEST(RateLimit, AClockThatStandsOrGoesBackGivesNothing) {
  RateLimit limit(2.0);
  EXPECT_EQ(pass(limit, 10.0, 5), 2);
  EXPECT_EQ(pass(limit, 9.0, 5), 0);
}

}  // namespace
}  // namespace ols::trust
