#include "base/bus/bus_client.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ols {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// A message of one byte.
struct Byte {
  int getEncodedSize() const { return 1; }
  int encode(void* bytes, int, int) const {
    *static_cast<unsigned char*>(bytes) = 7;
    return 1;
  }
};

TEST(BusClient, TheSameTroubleIsSaidOnce) {
  std::vector<std::string> told;
  BusClient client("nonsense://", nullptr, {},
                   [&](const std::string& text) { told.push_back(text); });
  EXPECT_EQ(client.trouble(), "no bus: connecting");
  for (const double now_s : {100.0, 101.5, 103.0}) {
    client.connect(now_s, BusConnector::kLongest_s);
    EXPECT_EQ(client.bus(), nullptr);
  }
  EXPECT_THAT(told, ElementsAre(HasSubstr("nonsense")));
  EXPECT_EQ(client.trouble(), "no bus: " + told.at(0));
}

TEST(BusClient, SubscribesAtEachConnectionAndTellsOfItsEndAndItsReturn) {
  int heard = 0, connections = 0;
  std::vector<std::string> told;
  BusClient client(
      "memq://", nullptr,
      [&](LcmBus& bus) {
        ++connections;
        bus.subscribe("A", [&](const BusMessage&) { ++heard; });
      },
      [&](const std::string& text) { told.push_back(text); });
  client.connect(100.0, BusConnector::kLongest_s);
  ASSERT_NE(client.bus(), nullptr);
  EXPECT_EQ(client.trouble(), "");
  EXPECT_THAT(told, ElementsAre());
  client.bus()->publish("A", Byte{});
  client.turn(100.1, 0);
  EXPECT_EQ(heard, 1);

  client.end("the network is down");
  EXPECT_EQ(client.bus(), nullptr);
  EXPECT_EQ(client.trouble(), "no bus: the network is down");
  EXPECT_THAT(client.all_alarms(100.2), ElementsAre("no bus: the network is down"));
  EXPECT_THAT(told, ElementsAre("the network is down"));

  client.connect(101.5, BusConnector::kLongest_s);
  ASSERT_NE(client.bus(), nullptr);
  EXPECT_EQ(connections, 2);
  EXPECT_EQ(client.trouble(), "");
  EXPECT_THAT(told, ElementsAre("the network is down", ""));
  client.bus()->publish("A", Byte{});
  client.turn(101.6, 0);
  EXPECT_EQ(heard, 2);
}

TEST(BusClient, ATurnWithoutAConnectionMakesOne) {
  BusClient client("memq://", nullptr);
  for (double now_s = 0.0; now_s < 60.0 && client.bus() == nullptr; now_s += 0.01) {
    client.turn(now_s, 10);
  }
  EXPECT_NE(client.bus(), nullptr);
}

TEST(BusClient, CountsOverAllConnections) {
  BusClient client("memq://", nullptr, [](LcmBus& bus) {
    bus.subscribe("A", [](const BusMessage&) {}, {.messages = 1});
  });
  for (const double now_s : {0.0, 2.0}) {
    client.connect(now_s, BusConnector::kLongest_s);
    ASSERT_NE(client.bus(), nullptr);
    for (int i = 0; i < 3; ++i) client.bus()->publish("A", Byte{});
    client.turn(now_s, 0);
    EXPECT_THAT(client.alarms(now_s), ElementsAre(HasSubstr("displaced")));
    client.end("for a test");
  }
  std::map<std::string, double> counters;
  client.count(counters);
  EXPECT_EQ(counters.at("bus_messages_overflowed"), 4.0);
}

}  // namespace
}  // namespace ols
