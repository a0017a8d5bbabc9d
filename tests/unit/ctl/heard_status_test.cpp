#include "tools/ctl/heard_status.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/lcm_bus.h"

namespace ols::ctl {
namespace {

ols_msg::station_status_t of_alfa() {
  ols_msg::station_status_t status{};
  status.schema_version = ols_msg::station_status_t::SCHEMA_VERSION;
  status.station = "alfa";
  return status;
}

BusMessage on(const std::string& channel, const ols_msg::station_status_t& status) {
  BusMessage message;
  message.channel = channel;
  message.payload.resize(static_cast<std::size_t>(status.getEncodedSize()));
  status.encode(message.payload.data(), 0, static_cast<int>(message.payload.size()));
  return message;
}

TEST(HeardStatus, IsOfTheStationWhoseChannelItIsOn) {
  EXPECT_EQ(heard_status(on("OLS_STATUS_alfa", of_alfa()))->station, "alfa");
  EXPECT_FALSE(heard_status(on("OLS_STATUS_bravo", of_alfa())));
}

TEST(HeardStatus, IsOfThisSchemaAndWhole) {
  ols_msg::station_status_t other = of_alfa();
  ++other.schema_version;
  EXPECT_FALSE(heard_status(on("OLS_STATUS_alfa", other)));
  BusMessage cut = on("OLS_STATUS_alfa", of_alfa());
  cut.payload.pop_back();
  EXPECT_FALSE(heard_status(cut));
}

TEST(HeardStatus, MovesNoCursor) {
  ols_msg::station_status_t status = of_alfa();
  status.last_error = "a\x1b[2J";
  status.alarm = {"b\nc"};
  status.alarms = 1;
  const auto heard = heard_status(on("OLS_STATUS_alfa", status));
  ASSERT_TRUE(heard);
  EXPECT_EQ(heard->last_error, "a?[2J");
  EXPECT_EQ(heard->alarm.at(0), "b?c");
}

}  // namespace
}  // namespace ols::ctl
