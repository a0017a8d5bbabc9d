#include "command/messages.h"

#include <gtest/gtest.h>

#include <string>

#include "base/lcm_bus.h"
#include "ols_msg/cue_order_t.hpp"
#include "ols_msg/designate_t.hpp"
#include "ols_msg/fusion_status_t.hpp"
#include "ols_msg/ptu_command_t.hpp"
#include "ols_msg/record_t.hpp"
#include "tests/unit/on_the_bus.h"

namespace ols::command {
namespace {

ols_msg::station_status_t of_alfa() {
  auto status = made<ols_msg::station_status_t>();
  status.station = "alfa";
  return status;
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

TEST(HeardCues, AreThoseOfTheFusionsStatus) {
  using M = ols_msg::fusion_status_t;
  auto status = made<M>();
  status.cues = 1;
  status.cue_id = {"tak.\x1b[2J"};
  status.cue_label = {"Anna"};
  status.cue_state = {M::CUE_SEARCHED};
  status.cue_target_id = {7};
  status.cue_age_s = {1.5};
  status.cue_latitude_deg = {49.0};
  status.cue_longitude_deg = {16.0};
  status.cue_height_m = {400.0};
  status.cue_horizontal_sd_m = {5.0};
  status.cue_vertical_sd_m = {9.0};
  status.counters = 1;
  status.counter_name = {"cue_orders_refused"};
  status.counter_value = {3.0};
  const auto said = heard_cues(on("OLS_FUSION_STATUS", status));
  ASSERT_TRUE(said);
  ASSERT_EQ(said->cues.size(), 1U);
  EXPECT_EQ(said->cues[0].id.find('\x1b'), std::string::npos);
  EXPECT_EQ(said->cues[0].label, "Anna");
  EXPECT_EQ(said->cues[0].state, "searched");
  EXPECT_EQ(said->cues[0].target_id, 7);
  EXPECT_EQ(said->cues[0].vertical_sd_m, 9.0);
  EXPECT_EQ(said->orders_refused, 3.0);
  ++status.schema_version;
  EXPECT_FALSE(heard_cues(on("OLS_FUSION_STATUS", status)));
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

template <class Message>
Message for_alfa() {
  auto message = made<Message>();
  message.station = "alfa";
  return message;
}

TEST(HeardOrder, IsWhatWasSent) {
  auto move = for_alfa<ols_msg::ptu_command_t>();
  move.command = ols_msg::ptu_command_t::COMMAND_POINT;
  move.pan_rad = 0.5;
  const auto point = heard_order(on("OLS_PTU_alfa", move));
  ASSERT_TRUE(point);
  EXPECT_EQ(point->kind, Kind::kPoint);
  EXPECT_EQ(point->pan_rad, 0.5);
  auto box = for_alfa<ols_msg::designate_t>();
  box.width_px = 30.0;
  EXPECT_EQ(heard_order(on("OLS_DESIGNATE_alfa", box))->kind, Kind::kDesignate);
  EXPECT_EQ(heard_order(on("OLS_DESIGNATE_alfa", box))->width_px, 30.0);
  auto record = for_alfa<ols_msg::record_t>();
  record.label = "a\x1b";
  EXPECT_EQ(heard_order(on("OLS_RECORD_alfa", record))->label, "a?");
}

TEST(HeardOrder, IsForTheStationOfItsChannelAndOfAKnownKind) {
  auto move = for_alfa<ols_msg::ptu_command_t>();
  EXPECT_FALSE(heard_order(on("OLS_PTU_bravo", move)));
  EXPECT_FALSE(heard_order(on("OLS_STATUS_alfa", move)));
  move.command = 99;
  EXPECT_FALSE(heard_order(on("OLS_PTU_alfa", move)));
}

TEST(OrderSender, NumbersItsWordsOnCues) {
  LcmBus bus("memq://");
  std::vector<ols_msg::cue_order_t> heard;
  bus.subscribe("OLS_CUE_ORDER", [&heard](const BusMessage& message) {
    ols_msg::cue_order_t order;
    if (decode_of_schema(message, order)) heard.push_back(order);
  });
  OrderSender sender(17);
  sender.send(bus, {"tak.anna", true}, 1'000);
  sender.send(bus, {"tak.anna", false}, 2'000);
  while (heard.size() < 2) ASSERT_GT(bus.handle(5'000), 0);
  std::int64_t number = 0;
  for (const auto& order : heard) {
    ++number;
    EXPECT_EQ(order.boot_id, 17);
    EXPECT_EQ(order.sequence, number);
    EXPECT_EQ(order.utime, 1'000 * number);
    EXPECT_EQ(order.cue, "tak.anna");
    EXPECT_EQ(order.allow, number == 1);
  }
}

}  // namespace
}  // namespace ols::command
