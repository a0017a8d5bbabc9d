#include "console/command_desk.h"

#include <gtest/gtest.h>

namespace ols::console {
namespace {

using command::Kind;
using command::Order;
using command::Reply;

Order order(Kind kind, const std::string& station = "alfa") {
  return {.station = station, .kind = kind};
}

TEST(CommandDesk, AnOrderIsSentOnceAndJudgedByTheStationsCounts) {
  CommandDesk desk;
  desk.hear("alfa", Reply{.counters = {{"home_accepted", 1}}});
  EXPECT_FALSE(desk.begin(order(Kind::kHome), {.viewer = 4, .number = 5}, 10.0));
  EXPECT_EQ(desk.due(10.0).size(), 1U);
  EXPECT_TRUE(desk.due(10.1).empty());
  EXPECT_TRUE(desk.finished(10.2).empty());
  desk.hear("alfa", Reply{.counters = {{"home_accepted", 2}}});
  const auto verdicts = desk.finished(10.3);
  ASSERT_EQ(verdicts.size(), 1U);
  EXPECT_TRUE(verdicts[0].outcome.accepted);
  EXPECT_EQ(verdicts[0].ticket.viewer, 4U);
  EXPECT_EQ(verdicts[0].ticket.number, 5);
  EXPECT_TRUE(desk.finished(10.4).empty());
}

TEST(CommandDesk, ARefusalComesInTheStationsWords) {
  CommandDesk desk;
  desk.hear("alfa", {});
  static_cast<void>(desk.begin(order(Kind::kPoint), {}, 0.0));
  static_cast<void>(desk.due(0.0));
  desk.hear("alfa", Reply{.counters = {{"refused_emergency", 1}}});
  EXPECT_EQ(desk.finished(0.1).at(0).outcome.why,
            "refused: the emergency stop holds; release it and re-arm first");
}

TEST(CommandDesk, WithoutAnAnswerItEndsWithTheLease) {
  CommandDesk desk;
  desk.hear("alfa", {});
  static_cast<void>(desk.begin(order(Kind::kPoint), {}, 0.0));
  static_cast<void>(desk.due(0.0));
  EXPECT_TRUE(desk.finished(command::kLease_s).empty());
  EXPECT_EQ(desk.finished(command::kLease_s + 0.01).at(0).outcome.why, "no answer");
}

TEST(CommandDesk, RefusesWhatItCouldNotJudge) {
  CommandDesk desk;
  EXPECT_EQ(desk.begin(order(Kind::kHome), {}, 0.0), "refused: no such station is heard");
  desk.hear("alfa", {});
  EXPECT_FALSE(desk.begin(order(Kind::kHome), {}, 0.0));
  EXPECT_EQ(desk.begin(order(Kind::kHome), {}, 0.0),
            "refused: the station has not answered the same command yet");
  EXPECT_FALSE(desk.begin(order(Kind::kPoint), {}, 0.0));
}

TEST(CommandDesk, ARateReplacesTheOneThatIsNotAnsweredYet) {
  CommandDesk desk;
  desk.hear("alfa", {});
  Order rate = order(Kind::kRate);
  EXPECT_FALSE(desk.is_held(rate, 10.0));
  for (int i = 1; i <= 3; ++i) {
    rate.pan_rate_rad_s = 0.1 * i;
    EXPECT_FALSE(desk.begin(rate, {.viewer = 4}, 10.0 + 0.1 * i));
    const auto due = desk.due(10.0 + 0.1 * i);
    ASSERT_EQ(due.size(), 1U);
    EXPECT_EQ(due[0].pan_rate_rad_s, 0.1 * i);
  }
  EXPECT_TRUE(desk.due(10.35).empty()) << "each is sent once: it would last longer than the hand";
  EXPECT_TRUE(desk.is_held(rate, 10.4));
  EXPECT_FALSE(desk.is_held(rate, 11.4));
  EXPECT_FALSE(desk.is_held({.station = "alfa", .kind = Kind::kLens, .lens_rates = true}, 10.4));
  desk.hear("alfa", Reply{.counters = {{"rate_accepted", 3}}});
  EXPECT_EQ(desk.finished(10.5).size(), 1U);
}

TEST(CommandDesk, AStopIsRepeatedUntilTheUnitStands) {
  CommandDesk desk;
  desk.hear("alfa", Reply{.counters = {{"stop_accepted", 3}}});
  EXPECT_FALSE(desk.begin(order(Kind::kStop), {}, 0.0));
  EXPECT_EQ(desk.due(0.0).size(), 1U);
  EXPECT_TRUE(desk.due(0.01).empty());
  EXPECT_EQ(desk.due(0.03).size(), 1U);
  desk.hear("alfa", Reply{.counters = {{"stop_accepted", 4}}});
  EXPECT_TRUE(desk.finished(0.1).empty()) << "counted, but it does not stand yet";
  desk.hear("alfa", Reply{.counters = {{"stop_accepted", 4}}, .stopped = true});
  EXPECT_TRUE(desk.finished(0.2).at(0).outcome.accepted);
  EXPECT_TRUE(desk.due(0.3).empty());
}

TEST(CommandDesk, ARecordingOfAnotherBootConfirmsNoStop) {
  CommandDesk desk;
  desk.hear("alfa", Reply{.counters = {{"stop_accepted", 3}}, .boot_id = 2});
  EXPECT_FALSE(desk.begin(order(Kind::kStop), {}, 0.0));
  static_cast<void>(desk.due(0.0));
  desk.hear("alfa", Reply{.counters = {{"stop_accepted", 9}}, .stopped = true, .boot_id = 1});
  EXPECT_TRUE(desk.finished(0.1).empty());
  desk.hear("alfa", Reply{.counters = {{"stop_accepted", 4}}, .stopped = true, .boot_id = 2});
  EXPECT_TRUE(desk.finished(0.2).at(0).outcome.accepted);
}

TEST(CommandDesk, AStopOfAStationThatNobodyKnowsIsRefused) {
  CommandDesk desk;
  EXPECT_EQ(desk.begin(order(Kind::kStop, "invented"), {}, 0.0),
            "refused: no such station is heard");
  EXPECT_TRUE(desk.due(0.0).empty());
}

TEST(CommandDesk, AStopThatIsOnItsWayAlreadyIsJoinedAndSentAtOnce) {
  CommandDesk desk;
  desk.hear("alfa", {});
  EXPECT_FALSE(desk.begin(order(Kind::kStop), {.number = 1, .event = 7, .who = "ana"}, 0.0));
  EXPECT_EQ(desk.due(0.0).size(), 1U);
  EXPECT_EQ(desk.stop_event("alfa", "ana"), 7U);
  EXPECT_EQ(desk.stop_event("alfa", "ben"), 0U);
  EXPECT_FALSE(desk.begin(order(Kind::kStop), {.number = 2, .who = "ben"}, 1.0));
  EXPECT_EQ(desk.due(1.0).size(), 1U) << "one order for both";
  EXPECT_FALSE(desk.begin(order(Kind::kStop), {.number = 3, .who = "ben"}, 1.005));
  EXPECT_EQ(desk.due(1.005).size(), 1U);
  EXPECT_TRUE(desk.due(1.01).empty());
  const auto first = desk.finished(CommandDesk::kStopPatience_s + 0.1);
  ASSERT_EQ(first.size(), 1U) << "each waits for its own time";
  EXPECT_EQ(first[0].ticket.number, 1);
  EXPECT_FALSE(first[0].outcome.accepted);
  desk.hear("alfa", Reply{.counters = {{"stop_accepted", 1}}, .stopped = true});
  const auto rest = desk.finished(CommandDesk::kStopPatience_s + 0.2);
  ASSERT_EQ(rest.size(), 2U);
  EXPECT_TRUE(rest[0].outcome.accepted && rest[1].outcome.accepted);
}

TEST(CommandDesk, AStationThatIsForgottenIsNotKnownAnyMore) {
  CommandDesk desk;
  desk.hear("alfa", {});
  desk.hear("bravo", {});
  desk.keep_only([](const std::string& id) { return id == "bravo"; });
  EXPECT_TRUE(desk.begin(order(Kind::kHome), {}, 0.0));
  EXPECT_FALSE(desk.begin(order(Kind::kHome, "bravo"), {}, 0.0));
}

TEST(CommandDesk, StopsAreNeitherRefusedNorHeapedUp) {
  CommandDesk desk;
  for (std::size_t i = 0; i < CommandDesk::kMostPending; ++i) {
    const std::string id = std::to_string(i);
    desk.hear(id, {});
    EXPECT_FALSE(desk.begin(order(Kind::kHome, id), {}, 0.0));
  }
  EXPECT_EQ(desk.begin(order(Kind::kPoint, "0"), {}, 0.0),
            "refused: too many commands are on their way");
  static_cast<void>(desk.due(0.0));
  for (int i = 0; i < 10000; ++i) {  // somebody holds the key
    const bool has_room = i < static_cast<int>(CommandDesk::kMostTickets);
    EXPECT_EQ(desk.begin(order(Kind::kStop, "0"), {}, 0.0).has_value(), !has_room);
  }
  EXPECT_EQ(desk.due(0.0).size(), 1U);
  EXPECT_EQ(desk.finished(CommandDesk::kStopPatience_s + 1.0).size(),
            CommandDesk::kMostPending + CommandDesk::kMostTickets);
}

}  // namespace
}  // namespace ols::console
