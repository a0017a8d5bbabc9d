#include "central/app/fusion_conflict_monitor.h"

#include <gtest/gtest.h>

namespace ols::fusion {
namespace {

TEST(FusionConflictMonitor, HearsAnyOneButItself) {
  FusionConflictMonitor others(7);
  EXPECT_FALSE(others.hear(7, 1.0));
  EXPECT_EQ(others.alarm(1.0), "");
  EXPECT_TRUE(others.hear(8, 2.0));
  EXPECT_TRUE(others.take_event());
  EXPECT_TRUE(others.hear(8, 3.0));
  EXPECT_FALSE(others.take_event()) << "once";
  EXPECT_NE(others.alarm(4.0), "");
  EXPECT_EQ(others.alarm(9.0), "") << "it has been ended";
}

}  // namespace
}  // namespace ols::fusion
