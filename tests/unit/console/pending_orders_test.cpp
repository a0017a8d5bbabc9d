#include "console/pending_orders.h"

#include <gtest/gtest.h>

namespace ols::console {
namespace {

using wire::Kind;
using wire::Order;
using wire::Reply;

Order order(Kind kind, const std::string& station = "alfa") {
  return {.station = station, .kind = kind};
}

// To the order that was sent as this one.
Reply answer(std::int64_t sequence, const std::string& reason = "", bool stopped = false) {
  return {.station = "alfa",
          .order = {0, sequence},
          .is_accepted = reason.empty(),
          .reason = reason,
          .is_stopped = stopped};
}

TEST(PendingOrders, AnOrderIsSentOnceAndItsAnswerIsTold) {
  PendingOrders orders;
  orders.receive("alfa", false);
  EXPECT_TRUE(orders.begin(order(Kind::kHome), {.viewer = 4, .number = 5}, 10.0).empty());
  EXPECT_EQ(orders.due(10.0).size(), 1U);
  EXPECT_TRUE(orders.due(10.1).empty());
  EXPECT_TRUE(orders.finished(10.2).empty());
  orders.receive(answer(1));
  const auto verdicts = orders.finished(10.3);
  ASSERT_EQ(verdicts.size(), 1U);
  EXPECT_EQ(verdicts[0].why, "");
  EXPECT_EQ(verdicts[0].ticket.viewer, 4U);
  EXPECT_EQ(verdicts[0].ticket.number, 5);
  EXPECT_TRUE(orders.finished(10.4).empty());
}

TEST(PendingOrders, EachOfTwoOrdersOnTheirWayHasItsOwnAnswer) {
  PendingOrders orders;
  orders.receive("alfa", false);
  for (const std::int64_t number : {1, 2}) {
    EXPECT_TRUE(orders.begin(order(Kind::kDesignate), {.number = number}, 0.0).empty());
  }
  EXPECT_EQ(orders.due(0.0).size(), 2U);
  orders.receive(answer(2, "emergency"));
  auto verdicts = orders.finished(0.1);
  ASSERT_EQ(verdicts.size(), 1U);
  EXPECT_EQ(verdicts[0].ticket.number, 2);
  EXPECT_EQ(verdicts[0].why, "refused: the emergency stop holds; release it and re-arm first");
  orders.receive(answer(1));
  verdicts = orders.finished(0.2);
  ASSERT_EQ(verdicts.size(), 1U);
  EXPECT_EQ(verdicts[0].ticket.number, 1);
  EXPECT_EQ(verdicts[0].why, "");
}

TEST(PendingOrders, AnswersToOthersOrdersAndOfOtherStationsAreNone) {
  PendingOrders orders;
  orders.receive("alfa", false);
  orders.receive("bravo", false);
  static_cast<void>(orders.begin(order(Kind::kHome), {}, 0.0));
  static_cast<void>(orders.due(0.0));
  for (Reply reply : {answer(1), answer(1), answer(2)}) {
    if (reply.order.sequence == 1) reply.order.boot_id = 7;
    orders.receive(reply);
    reply = answer(1);
    reply.station = "bravo";
    orders.receive(reply);
  }
  EXPECT_TRUE(orders.finished(0.1).empty());
}

// As a log has it.
TEST(PendingOrders, OfAnOrderThatIsOnlyWatchedTheAnswerIsToldIfThereIsOne) {
  PendingOrders orders;
  orders.receive("alfa", false);
  Order stop = order(Kind::kStop);
  stop.id = {9, 1};
  static_cast<void>(orders.begin(stop, {.event = 3, .is_watched = true}, 0.0));
  stop.id = {9, 2};
  orders.watch_again(stop);
  EXPECT_TRUE(orders.due(1.0).empty());
  Reply reply = answer(2, "", true);
  reply.order.boot_id = 9;
  orders.receive(reply);
  ASSERT_EQ(orders.finished(1.0).size(), 1U);
  Order home = order(Kind::kHome);
  home.id = {9, 3};
  static_cast<void>(orders.begin(home, {.is_watched = true}, 2.0));
  EXPECT_TRUE(orders.finished(2.0 + wire::kLease_s + 0.1).empty());
}

TEST(PendingOrders, WithoutAnAnswerItEndsWithTheLease) {
  PendingOrders orders;
  orders.receive("alfa", false);
  static_cast<void>(orders.begin(order(Kind::kPoint), {}, 0.0));
  static_cast<void>(orders.due(0.0));
  EXPECT_TRUE(orders.finished(wire::kLease_s).empty());
  EXPECT_EQ(orders.finished(wire::kLease_s + 0.01).at(0).why, "no answer");
}

TEST(PendingOrders, ARateIsSentThoughTheOneBeforeIsAnsweredFirst) {
  PendingOrders orders;
  orders.receive("alfa", false);
  Order rate = order(Kind::kRate);
  rate.pan_rate_rad_s = 0.1;
  static_cast<void>(orders.begin(rate, {.viewer = 4}, 10.0));
  static_cast<void>(orders.due(10.0));
  rate.pan_rate_rad_s = 0.0;  // the hand lets go
  static_cast<void>(orders.begin(rate, {.viewer = 4}, 10.1));
  orders.receive(answer(1));
  EXPECT_TRUE(orders.finished(10.1).empty());
  const auto due = orders.due(10.1);
  ASSERT_EQ(due.size(), 1U);
  EXPECT_EQ(due[0].pan_rate_rad_s, 0.0);
  EXPECT_EQ(orders.finished(10.2).size(), 1U);
}

TEST(PendingOrders, ARateReplacesTheOneThatIsNotAnsweredYet) {
  PendingOrders orders;
  orders.receive("alfa", false);
  Order rate = order(Kind::kRate);
  EXPECT_FALSE(orders.is_held(rate, 10.0));
  for (int i = 1; i <= 3; ++i) {
    rate.pan_rate_rad_s = 0.1 * i;
    EXPECT_TRUE(orders.begin(rate, {.viewer = 4}, 10.0 + 0.1 * i).empty());
    const auto due = orders.due(10.0 + 0.1 * i);
    ASSERT_EQ(due.size(), 1U);
    EXPECT_EQ(due[0].pan_rate_rad_s, 0.1 * i);
  }
  EXPECT_TRUE(orders.due(10.35).empty()) << "each is sent once: it would last longer than the hand";
  EXPECT_TRUE(orders.is_held(rate, 10.4));
  EXPECT_FALSE(orders.is_held(rate, 11.4));
  EXPECT_FALSE(orders.is_held({.station = "alfa", .kind = Kind::kLens, .lens_rates = true}, 10.4));
  orders.receive(answer(2));
  EXPECT_EQ(orders.finished(10.5).size(), 1U) << "to any of them";
}

TEST(PendingOrders, AStopIsRepeatedUntilTheUnitStands) {
  PendingOrders orders;
  orders.receive("alfa", false);
  EXPECT_TRUE(orders.begin(order(Kind::kStop), {}, 0.0).empty());
  EXPECT_EQ(orders.due(0.0).size(), 1U);
  EXPECT_TRUE(orders.due(0.01).empty());
  EXPECT_EQ(orders.due(0.03).size(), 1U);
  orders.receive(answer(1, "other_boot"));
  orders.receive(answer(1));
  EXPECT_TRUE(orders.finished(0.1).empty()) << "it does not stand yet";
  orders.receive(answer(2, "", true));
  EXPECT_EQ(orders.finished(0.2).at(0).why, "");
  EXPECT_TRUE(orders.is_stopped("alfa")) << "its next status is no news";
  EXPECT_TRUE(orders.due(0.3).empty());
}

TEST(PendingOrders, AStopOfAStationThatNobodyKnowsIsRefused) {
  PendingOrders orders;
  EXPECT_EQ(orders.begin(order(Kind::kStop, "invented"), {}, 0.0),
            "refused: no such station is heard");
  EXPECT_TRUE(orders.due(0.0).empty());
}

TEST(PendingOrders, AStopThatIsOnItsWayAlreadyIsJoinedAndSentAtOnce) {
  PendingOrders orders;
  orders.receive("alfa", false);
  EXPECT_TRUE(
      orders.begin(order(Kind::kStop), {.number = 1, .event = 7, .who = "ana"}, 0.0).empty());
  EXPECT_EQ(orders.due(0.0).size(), 1U);
  EXPECT_EQ(orders.stop_event("alfa", "ana"), 7U);
  EXPECT_EQ(orders.stop_event("alfa", "ben"), 0U);
  EXPECT_TRUE(orders.begin(order(Kind::kStop), {.number = 2, .who = "ben"}, 1.0).empty());
  EXPECT_EQ(orders.due(1.0).size(), 1U) << "one order for both";
  EXPECT_TRUE(orders.begin(order(Kind::kStop), {.number = 3, .who = "ben"}, 1.005).empty());
  EXPECT_EQ(orders.due(1.005).size(), 1U);
  EXPECT_TRUE(orders.due(1.01).empty());
  const auto first = orders.finished(PendingOrders::kStopPatience_s + 0.1);
  ASSERT_EQ(first.size(), 1U) << "each waits for its own time";
  EXPECT_EQ(first[0].ticket.number, 1);
  EXPECT_EQ(first[0].why, "sent repeatedly, no answer");
  orders.receive(answer(1, "", true));
  const auto rest = orders.finished(PendingOrders::kStopPatience_s + 0.2);
  ASSERT_EQ(rest.size(), 2U);
  EXPECT_TRUE(rest[0].why.empty() && rest[1].why.empty());
}

TEST(PendingOrders, AStationThatIsForgottenIsNotKnownAnyMore) {
  PendingOrders orders;
  orders.receive("alfa", false);
  orders.receive("bravo", false);
  orders.keep_only([](const std::string& id) { return id == "bravo"; });
  EXPECT_FALSE(orders.begin(order(Kind::kHome), {}, 0.0).empty());
  EXPECT_TRUE(orders.begin(order(Kind::kHome, "bravo"), {}, 0.0).empty());
}

TEST(PendingOrders, StopsAreNeitherRefusedNorHeapedUp) {
  PendingOrders orders;
  for (std::size_t i = 0; i < PendingOrders::kMostPending; ++i) {
    const std::string id = std::to_string(i);
    orders.receive(id, false);
    EXPECT_TRUE(orders.begin(order(Kind::kHome, id), {}, 0.0).empty());
  }
  EXPECT_EQ(orders.begin(order(Kind::kPoint, "0"), {}, 0.0),
            "refused: too many commands are on their way");
  static_cast<void>(orders.due(0.0));
  for (int i = 0; i < 10000; ++i) {  // somebody holds the key
    const bool has_room = i < static_cast<int>(PendingOrders::kMostTickets);
    EXPECT_EQ(orders.begin(order(Kind::kStop, "0"), {}, 0.0).empty(), has_room);
  }
  EXPECT_EQ(orders.due(0.0).size(), 1U);
  EXPECT_EQ(orders.finished(PendingOrders::kStopPatience_s + 1.0).size(),
            PendingOrders::kMostPending + PendingOrders::kMostTickets);
}

}  // namespace
}  // namespace ols::console
