#include "console/event_list.h"

#include <gtest/gtest.h>

#include "conditions/alarms.h"

namespace ols::console {
namespace {

TEST(EventList, AnOutcomeComesLater) {
  EventList events;
  Revision revision = 0;
  const auto number = events.add({5, "command", "alfa", "ana", "home", ""}, revision);
  const Revision before = revision;
  EXPECT_TRUE(events.since(before).empty());
  events.conclude(number, {}, revision);
  ASSERT_EQ(events.since(before).size(), 1U);
  EXPECT_EQ(events.since(before)[0].at("outcome"), "done");
  EXPECT_EQ(events.since(before)[0].at("who"), "ana");
}

TEST(EventList, WhatRepeatsItselfIsCountedAndMovesToTheEnd) {
  EventList events;
  Revision revision = 0;
  for (int i = 0; i < 5; ++i) events.add({i, "error", "alfa", "", "no reply", ""}, revision);
  events.add({5, "error", "bravo", "", "no reply", ""}, revision);
  const Revision before = revision;
  events.add({6, "error", "alfa", "", "no reply", ""}, revision);
  ASSERT_EQ(events.since(0).size(), 2U);
  EXPECT_EQ(events.since(0)[1].at("station"), "alfa");
  EXPECT_EQ(events.since(0)[1].at("times"), 6);
  EXPECT_EQ(events.since(0)[1].at("utime_us"), 6);
  EXPECT_EQ(events.since(before).size(), 1U);
  events.add({6 + EventList::kRepeat_us, "error", "alfa", "", "no reply", ""}, revision);
  ASSERT_EQ(events.since(0).size(), 3U) << "a minute later it is another";
  for (int i = 0; i < 2; ++i) events.add({0, "command", "alfa", "ana", "stop", ""}, revision);
  EXPECT_EQ(events.since(0).size(), 5U) << "each command stands for itself";
}

TEST(EventList, AnAlarmThatComesBackIsTheNewest) {
  EventList events;
  Revision revision = 0;
  events.add({1, "alarm", "alfa", "", "no frames", ""}, revision);
  events.add({2, "error", "bravo", "", "no reply", ""}, revision);
  events.end("alfa", "no frames", 2, revision);
  EXPECT_EQ(events.since(0).front().at("over_us"), 2);
  events.add({3, "alarm", "alfa", "", "no frames", ""}, revision);
  ASSERT_EQ(events.since(0).size(), 2U);
  EXPECT_EQ(events.since(0).back().at("kind"), "alarm");
  EXPECT_EQ(events.since(0).back().at("utime_us"), 3);
  EXPECT_EQ(events.since(0).back().at("times"), 2);
  EXPECT_TRUE(events.since(0).back().at("over_us").is_null());
}

TEST(EventList, AnAlarmIsOneRowWhateverItsNumbersAndWhateverErrorExplainsIt) {
  EventList events;
  Revision revision = 0;
  const Alarm alarm = alarm::camera_no_frames(3.0);
  events.add({1, "alarm", "alfa", "", alarm.text, "", alarm}, revision);
  EXPECT_EQ(events.add({1, "error", "alfa", "", "camera: no frames for 3.4 s", ""}, revision), 0U);
  EXPECT_EQ(events.add({2, "error", "alfa", "", "camera x does not answer: no", ""}, revision), 0U);
  events.end("alfa", "camera_no_frames", 5, revision);
  ASSERT_EQ(events.since(0).size(), 1U);
  EXPECT_EQ(events.since(0)[0].at("key"), "camera_no_frames");
  EXPECT_EQ(events.since(0)[0].at("over_us"), 5);
  EXPECT_NE(events.add({6, "error", "alfa", "", "camera x does not answer: no", ""}, revision), 0U);
}

TEST(EventList, AnErrorBecomesTheAlarmThatFollowsIt) {
  EventList events;
  Revision revision = 0;
  events.add({1, "error", "bravo", "", "camera x does not answer: no", ""}, revision);
  const auto number =
      events.add({1, "error", "alfa", "", "camera x does not answer: no", ""}, revision);
  events.add({2, "alarm", "alfa", "", "", "", alarm::ptu_no_reference()}, revision);
  const Revision before = revision;
  EXPECT_EQ(events.add({3, "alarm", "alfa", "", "", "", alarm::camera_no_frames(3.0)}, revision),
            number);
  ASSERT_EQ(events.since(before).size(), 1U);
  EXPECT_EQ(events.since(before)[0].at("kind"), "alarm");
  EXPECT_EQ(events.since(0).size(), 3U);
  events.add({1, "error", "alfa", "", "gnss x does not answer", ""}, revision);
  events.add({1 + 60'000'000, "alarm", "alfa", "", "", "", alarm::gnss_fails("no")}, revision);
  EXPECT_EQ(events.since(0).size(), 5U) << "a minute later it is another";
}

TEST(EventList, TheAlarmsOfTwoStationsAreTwo) {
  EventList events;
  Revision revision = 0;
  events.add({1, "alarm", "", "", "", "", alarm::station_clock_error("s1", 3.0)}, revision);
  events.add({1, "alarm", "", "", "", "", alarm::station_clock_error("s2", 3.0)}, revision);
  events.end("", "station_clock_error s1", 2, revision);
  EXPECT_EQ(events.since(0)[0].at("over_us"), 2);
  EXPECT_TRUE(events.since(0)[1].at("over_us").is_null());
}

TEST(EventList, ARefusedCommandIsItsOwnRowOnly) {
  EventList events;
  Revision revision = 0;
  events.add({1, "command", "alfa", "ana", "designate", ""}, revision);
  EXPECT_EQ(events.add({2, "error", "alfa", "", "designate refused: no_frame", ""}, revision), 0U);
  EXPECT_NE(events.add({2, "error", "bravo", "", "designate refused: no_frame", ""}, revision), 0U);
}

TEST(EventList, AnAcknowledgementNamesWhoGaveIt) {
  EventList events;
  Revision revision = 0;
  const auto alarm = events.add({1, "alarm", "alfa", "", "no frames", ""}, revision);
  const auto command = events.add({1, "command", "alfa", "ana", "stop", ""}, revision);
  const Revision before = revision;
  EXPECT_FALSE(events.acknowledge(command, "ben", revision));
  EXPECT_FALSE(events.acknowledge(99, "ben", revision));
  EXPECT_TRUE(events.acknowledge(alarm, "ben", revision));
  ASSERT_EQ(events.since(before).size(), 1U);
  EXPECT_EQ(events.since(before)[0].at("acknowledged"), "ben");
}

TEST(EventList, AnAlarmThatHoldsIsNotPushedOut) {
  EventList events;
  Revision revision = 0;
  events.add({0, "alarm", "alfa", "", "no frames", ""}, revision);
  for (std::size_t i = 0; i < EventList::kMost; ++i) {
    events.add({0, "command", "", "", std::to_string(i), ""}, revision);
  }
  EXPECT_EQ(events.since(0).front().at("text"), "no frames");
}

TEST(EventList, KeepsTheNewest) {
  EventList events;
  Revision revision = 0;
  for (std::size_t i = 0; i < EventList::kMost + 10; ++i) {
    events.add({0, "command", "", "", std::to_string(i), ""}, revision);
  }
  EXPECT_EQ(events.since(0).size(), EventList::kMost);
  EXPECT_EQ(events.since(0).front().at("text"), "10");
}

}  // namespace
}  // namespace ols::console
