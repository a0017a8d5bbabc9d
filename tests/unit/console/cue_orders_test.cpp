#include "console/cue_orders.h"

#include <gtest/gtest.h>

namespace ols::console {
namespace {

const Ticket kAna{.viewer = 7, .number = 8, .event = 9};

TEST(CueOrders, GoOutOnceAndFromOperatorsOnly) {
  CueOrders orders;
  EXPECT_EQ(orders.refusal(Role::kViewer, {}), "refused: a viewer may only look and stop");
  EXPECT_EQ(orders.refusal(Role::kOperator, {"no bus"}), "no bus");
  EXPECT_EQ(orders.refusal(Role::kOperator, {}), "");
  orders.give({"tak.a", true}, kAna, 1.0);
  orders.give({"tak.b", false}, kAna, 1.0);
  const auto given = orders.take();
  ASSERT_EQ(given.size(), 2U);
  EXPECT_EQ(given[0].cue, "tak.a");
  EXPECT_TRUE(given[0].allow);
  EXPECT_LT(given[0].id, given[1].id) << "the fusion takes none twice";
  EXPECT_TRUE(orders.take().empty());
}

TEST(CueOrders, AreDoneWhenTheFusionSaysSo) {
  CueOrders orders;
  orders.give({"tak.a", true}, kAna, 1.0);
  const wire::OrderId id = orders.take().at(0).id;
  EXPECT_TRUE(orders.finished(1.5).empty());
  orders.receive({.station = "alfa", .order = id, .is_accepted = true});
  EXPECT_TRUE(orders.finished(1.5).empty()) << "a station's order has this number, too";
  orders.receive({.order = id, .is_accepted = true});
  const auto done = orders.finished(1.5);
  ASSERT_EQ(done.size(), 1U);
  EXPECT_EQ(done[0].ticket.viewer, 7U);
  EXPECT_EQ(done[0].ticket.number, 8);
  EXPECT_EQ(done[0].why, "");
  EXPECT_TRUE(orders.finished(9.0).empty());
}

TEST(CueOrders, AreRefusedInWordsOrNotAnswered) {
  CueOrders orders;
  orders.give({"tak.a", true}, kAna, 1.0);
  orders.give({"tak.b", true}, kAna, 1.0);
  orders.receive({.order = orders.take().at(0).id, .reason = "no_cue"});
  EXPECT_EQ(orders.finished(1.1).at(0).why.id, "order_refused");
  EXPECT_TRUE(orders.finished(2.9).empty());
  EXPECT_EQ(orders.finished(3.1).at(0).why, "no answer");
}

TEST(CueOrders, AreBounded) {
  CueOrders orders;
  for (int i = 0; i < 100; ++i) orders.give({"a", true}, kAna, 1.0);
  EXPECT_EQ(orders.refusal(Role::kOperator, {}), "refused: too many commands are on their way");
  EXPECT_EQ(orders.finished(9.0).size(), 100U);
  EXPECT_EQ(orders.refusal(Role::kOperator, {}), "");
}

}  // namespace
}  // namespace ols::console
