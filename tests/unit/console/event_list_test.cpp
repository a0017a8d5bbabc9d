#include "console/event_list.h"

#include <gtest/gtest.h>

namespace ols::console {
namespace {

TEST(EventList, AnOutcomeComesLater) {
  EventList events;
  Revision revision = 0;
  const auto number = events.add({5, "command", "alfa", "ana", "home", ""}, revision);
  const Revision before = revision;
  EXPECT_TRUE(events.since(before).empty());
  events.conclude(number, "done", revision);
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
  events.add({2, "alarm_over", "alfa", "", "no frames", ""}, revision);
  events.add({3, "alarm", "alfa", "", "no frames", ""}, revision);
  ASSERT_EQ(events.since(0).size(), 2U);
  EXPECT_EQ(events.since(0).back().at("kind"), "alarm");
  EXPECT_EQ(events.since(0).back().at("utime_us"), 3);
}

TEST(EventList, KeepsTheNewest) {
  EventList events;
  Revision revision = 0;
  for (std::size_t i = 0; i < EventList::kMost + 10; ++i) {
    events.add({0, "error", "", "", std::to_string(i), ""}, revision);
  }
  EXPECT_EQ(events.since(0).size(), EventList::kMost);
  EXPECT_EQ(events.since(0).front().at("text"), "10");
}

}  // namespace
}  // namespace ols::console
