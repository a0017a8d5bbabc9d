#include "base/bus_monitor.h"

#include <gtest/gtest.h>

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
  EXPECT_NE(watch.alarm(30.0).find("bus: 3 fragments and 0 malformed"), std::string::npos);
}

TEST(BusMonitor, AlarmsOfUnreadMessagesDisplaced) {
  BusMonitor watch;
  watch.look({.received = 100}, 0.0);
  watch.look({.received = 5000, .overflowed = 7}, 1.0);
  EXPECT_NE(watch.alarm(1.0).find("7 messages displaced"), std::string::npos);
}

TEST(BusMonitor, CountsOverAllConnections) {
  BusMonitor watch;
  watch.look({.fragments = 2, .overflowed = 7, .unsendable = 1}, 1.0);
  watch.connection_ended();
  watch.look({.fragments = 3, .malformed = 4}, 2.0);
  std::map<std::string, double> counters;
  watch.count(counters);
  EXPECT_EQ(counters.at("bus_fragments_refused"), 5.0);
  EXPECT_EQ(counters.at("bus_datagrams_malformed"), 4.0);
  EXPECT_EQ(counters.at("bus_messages_overflowed"), 7.0);
  EXPECT_EQ(counters.at("bus_messages_unsendable"), 1.0);
}

}  // namespace
}  // namespace ols
