#include "bridge/channel_rate_limits.h"

#include <gtest/gtest.h>

namespace ols::bridge {
namespace {

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
