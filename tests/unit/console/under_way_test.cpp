#include "console/under_way.h"

#include <gtest/gtest.h>

namespace ols::console {
namespace {

TEST(UnderWay, HoldsNothingBackFromABrowserThatNeverSaysWhatItHasTaken) {
  UnderWay under_way;
  under_way.sent("alfa");
  EXPECT_TRUE(under_way.may("alfa"));
}

TEST(UnderWay, OneOfEachUntilItIsTaken) {
  UnderWay under_way;
  under_way.sent("alfa");
  under_way.sent(UnderWay::kState);
  under_way.taken("bravo");
  EXPECT_FALSE(under_way.may("alfa"));
  EXPECT_FALSE(under_way.may(UnderWay::kState));
  EXPECT_TRUE(under_way.may("bravo"));
  under_way.taken("alfa");
  EXPECT_TRUE(under_way.may("alfa"));
  EXPECT_FALSE(under_way.may(UnderWay::kState));
}

}  // namespace
}  // namespace ols::console
