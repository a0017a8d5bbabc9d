#include <gtest/gtest.h>

#include "central/app/other_fusions.h"

namespace ols {
namespace {

TEST(OtherFusions, HearsAnyOneButItself) {
  OtherFusions others(7);
  EXPECT_FALSE(others.hear(7, 1.0));
  EXPECT_EQ(others.alarm(1.0), "");
  EXPECT_TRUE(others.hear(8, 2.0));
  EXPECT_TRUE(others.take_news());
  EXPECT_TRUE(others.hear(8, 3.0));
  EXPECT_FALSE(others.take_news()) << "once";
  EXPECT_NE(others.alarm(4.0), "");
  EXPECT_EQ(others.alarm(9.0), "") << "it has been ended";
}

}  // namespace
}  // namespace ols
