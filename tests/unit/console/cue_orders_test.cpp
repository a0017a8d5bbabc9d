#include "console/cue_orders.h"

#include <gtest/gtest.h>

namespace ols::console {
namespace {

TEST(CueOrders, GoOutOnceAndFromOperatorsOnly) {
  CueOrders orders;
  EXPECT_EQ(orders.give({"tak.a", true}, Role::kViewer, ""),
            "refused: a viewer may only look and stop");
  EXPECT_EQ(orders.give({"tak.a", true}, Role::kOperator, "no bus"), "no bus");
  EXPECT_TRUE(orders.take().empty());
  EXPECT_EQ(orders.give({"tak.a", true}, Role::kOperator, ""), "");
  const auto given = orders.take();
  ASSERT_EQ(given.size(), 1U);
  EXPECT_EQ(given[0].cue, "tak.a");
  EXPECT_TRUE(given[0].allow);
  EXPECT_TRUE(orders.take().empty());
}

TEST(CueOrders, AreBounded) {
  CueOrders orders;
  for (int i = 0; i < 100; ++i) EXPECT_EQ(orders.give({"a", true}, Role::kOperator, ""), "");
  EXPECT_EQ(orders.give({"a", true}, Role::kOperator, ""), "refused: too many at once");
}

}  // namespace
}  // namespace ols::console
