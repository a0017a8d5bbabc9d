#include "base/bus/bus_connector.h"

#include <gtest/gtest.h>

namespace ols {
namespace {

TEST(BusConnector, SaysWhyThereIsNoBusAndTriesAgainAfterASecond) {
  BusConnector connector("nonsense://");
  EXPECT_EQ(connector.take(100.0, BusConnector::kLongest_s), nullptr);
  const std::string why = connector.trouble();
  EXPECT_NE(why.find("nonsense"), std::string::npos) << why;
  EXPECT_EQ(connector.take(100.5, BusConnector::kLongest_s), nullptr);  // not due yet
  EXPECT_EQ(connector.take(101.5, BusConnector::kLongest_s), nullptr);
  EXPECT_EQ(connector.trouble(), why);
}

TEST(BusConnector, HandsOverABusOnce) {
  BusConnector connector("memq://");
  const auto bus = connector.take(0.0, BusConnector::kLongest_s);
  ASSERT_NE(bus, nullptr);
  EXPECT_EQ(connector.trouble(), "");
  int heard = 0;
  bus->subscribe("A", [&](const BusMessage&) { ++heard; });
  EXPECT_EQ(bus->handle(0), 0);
}

}  // namespace
}  // namespace ols
