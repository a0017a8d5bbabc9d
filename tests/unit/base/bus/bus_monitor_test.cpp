#include "base/bus/bus_monitor.h"

#include <gtest/gtest.h>

#include "conditions/alarms.h"

namespace ols {
namespace {

TEST(BusMonitor, AlarmsWhileDatagramsAreRefusedAndForAWhileAfterwards) {
  BusMonitor watch;
  watch.look({.received = 100}, 0.0);
  EXPECT_EQ(watch.alarm(0.0), "");
  watch.look({.received = 100, .fragments = 2}, 1.0);
  watch.look({.received = 100, .fragments = 2, .malformed = 1}, 2.0);
  EXPECT_EQ(watch.alarm(2.0),
            "bus: 2 fragments and 1 malformed datagrams refused, 0 messages displaced by newer "
            "ones: a flood, or a foreign program on the bus");
  EXPECT_NE(watch.alarm(2.0 + BusMonitor::kAlarm_s), "");
  EXPECT_EQ(watch.alarm(2.1 + BusMonitor::kAlarm_s), "");
  watch.look({.received = 100, .fragments = 5, .malformed = 1}, 30.0);
  EXPECT_NE(watch.alarm(30.0).text.find("bus: 3 fragments and 0 malformed"), std::string::npos);
}

TEST(BusMonitor, AlarmsOfUnreadMessagesDisplaced) {
  BusMonitor watch;
  watch.look({.received = 100}, 0.0);
  watch.look({.received = 5000, .overflowed = 7}, 1.0);
  EXPECT_NE(watch.alarm(1.0).text.find("7 messages displaced"), std::string::npos);
}

TEST(BusMonitor, CountsOverAllConnections) {
  BusMonitor watch;
  watch.look({.fragments = 2, .overflowed = 7, .unsendable = 1, .dropped = 6}, 1.0);
  watch.connection_ended();
  watch.look({.fragments = 3, .malformed = 4, .dropped = 5}, 2.0);
  std::map<std::string, double> counters;
  watch.count(counters);
  EXPECT_EQ(counters.at("bus_fragments_refused"), 5.0);
  EXPECT_EQ(counters.at("bus_datagrams_malformed"), 4.0);
  EXPECT_EQ(counters.at("bus_messages_overflowed"), 7.0);
  EXPECT_EQ(counters.at("bus_messages_unsendable"), 1.0);
  EXPECT_EQ(counters.at("bus_datagrams_dropped"), 11.0);
}

TEST(BusMonitor, WhatIsNotBelievedIsCountedByReasonAndToldOnce) {
  BusMonitor monitor;
  BusTraffic traffic;
  monitor.look(traffic, 0.0);
  std::map<std::string, double> counters;
  monitor.count(counters);
  EXPECT_FALSE(counters.contains("bus_distrusted_unsigned"));
  EXPECT_TRUE(monitor.alarms(0.0).empty());
  traffic.distrusted[static_cast<std::size_t>(trust::Distrust::kUnsigned)] = 3;
  traffic.distrusted[static_cast<std::size_t>(trust::Distrust::kReplayed)] = 1;
  traffic.distrusted_last = "OLS_PTU_a: replayed, by anna";
  monitor.look(traffic, 1.0);
  monitor.count(counters);
  EXPECT_EQ(counters.at("bus_distrusted_unsigned"), 3.0);
  ASSERT_EQ(monitor.alarms(2.0).size(), 1U);
  EXPECT_EQ(
      monitor.alarms(2.0).front(),
      "trust: messages not believed: 3 unsigned, 1 replayed; the last: OLS_PTU_a: replayed, by "
      "anna");
  EXPECT_TRUE(monitor.alarms(12.0).empty());
  monitor.look(traffic, 12.0);
  traffic.distrusted[0] = 4;
  monitor.look(traffic, 13.0);
  EXPECT_EQ(monitor.alarms(13.0).front().text.substr(0, 43),
            "trust: messages not believed: 1 unsigned; t")
      << "the earlier ones are over";
  monitor.connection_ended();
  monitor.count(counters);
  EXPECT_EQ(counters.at("bus_distrusted_unsigned"), 4.0);
}

TEST(BusMonitor, TroubleWithKeysStandsUntilItIsPutRight) {
  BusMonitor monitor;
  BusTraffic traffic;
  traffic.trust_trouble = alarm::own_key_not_in_list("alfa", 1);
  monitor.look(traffic, 1.0);
  EXPECT_EQ(monitor.alarms(100.0), std::vector<Alarm>{traffic.trust_trouble});
  traffic.trust_trouble = {};
  monitor.look(traffic, 101.0);
  EXPECT_TRUE(monitor.alarms(101.0).empty());
}

}  // namespace
}  // namespace ols
