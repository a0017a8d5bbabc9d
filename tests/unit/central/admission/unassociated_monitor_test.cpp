#include "central/admission/unassociated_monitor.h"

#include <gtest/gtest.h>

namespace ols::fusion {
namespace {

constexpr std::int64_t kStart = 1'600'000'000'000'000;

void follow(UnassociatedMonitor& monitor, int from_s, int to_s) {
  for (int s = from_s; s <= to_s; ++s) monitor.unexplained("a", kStart + s * 1'000'000LL);
}

TEST(UnassociatedMonitor, NamesWhoFollowsNoTargetForLong) {
  UnassociatedMonitor monitor({.alarm_s = 10.0});
  follow(monitor, 0, 9);
  EXPECT_EQ(monitor.alarm("a", kStart + 9'000'000), "");
  follow(monitor, 10, 10);
  EXPECT_NE(monitor.alarm("a", kStart + 10'000'000).text.find("station a: has followed for 10 s"),
            std::string::npos);
  EXPECT_EQ(monitor.alarm("a", kStart + 14'000'000), "") << "after a silence";
}

TEST(UnassociatedMonitor, OneBearingOfATargetOrASilenceBeginsTheCountAnew) {
  UnassociatedMonitor monitor({.alarm_s = 10.0});
  follow(monitor, 0, 9);
  monitor.explained("a");
  follow(monitor, 10, 15);
  EXPECT_EQ(monitor.alarm("a", kStart + 15'000'000), "");
  follow(monitor, 20, 29);
  EXPECT_EQ(monitor.alarm("a", kStart + 29'000'000), "");
}

}  // namespace
}  // namespace ols::fusion
