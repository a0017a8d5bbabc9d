#include "base/bus/bus_connector.h"

#include <gtest/gtest.h>

#include <set>

#include "base/bus/boot_id.h"

namespace ols {
namespace {

TEST(BootId, IsANewOneEachTimeAndNeverNegative) {
  std::set<std::int64_t> drawn;
  for (int i = 0; i < 1000; ++i) drawn.insert(draw_boot_id());
  EXPECT_EQ(drawn.size(), 1000U);
  EXPECT_GE(*drawn.begin(), 0);
  EXPECT_GT(*drawn.rbegin(), std::int64_t{1} << 62) << "all 63 bits are drawn";
}

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
