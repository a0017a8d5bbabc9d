#include "wire/orders.h"

#include <gtest/gtest.h>

#include <array>
#include <utility>

#include "ols_msg/command_reply_t.hpp"
#include "ols_msg/cue_order_t.hpp"
#include "ols_msg/designate_t.hpp"
#include "ols_msg/ptu_command_t.hpp"
#include "ols_msg/record_t.hpp"
#include "tests/unit/on_the_bus.h"
#include "wire/refusal_words.h"

namespace ols::wire {
namespace {

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
  const auto point = decode_order(on("OLS_PTU_alfa", move));
  ASSERT_TRUE(point);
  EXPECT_EQ(point->kind, Kind::kPoint);
  EXPECT_EQ(point->pan_rad, 0.5);
  auto box = for_alfa<ols_msg::designate_t>();
  box.width_px = 30.0;
  EXPECT_EQ(decode_order(on("OLS_DESIGNATE_alfa", box))->kind, Kind::kDesignate);
  EXPECT_EQ(decode_order(on("OLS_DESIGNATE_alfa", box))->width_px, 30.0);
  auto record = for_alfa<ols_msg::record_t>();
  record.label = "a\x1b";
  EXPECT_EQ(decode_order(on("OLS_RECORD_alfa", record))->label, "a?");
}

TEST(HeardOrder, IsOfTheKindThatTheMessageStates) {
  using M = ols_msg::ptu_command_t;
  static constexpr std::array<std::pair<std::int8_t, Kind>, 6> kKinds{
      {{M::COMMAND_STOP, Kind::kStop},
       {M::COMMAND_RELEASE, Kind::kRelease},
       {M::COMMAND_REARM, Kind::kRearm},
       {M::COMMAND_HOME, Kind::kHome},
       {M::COMMAND_REFERENCE_OK, Kind::kReferenceOk},
       {M::COMMAND_CENTRE, Kind::kCentre}}};
  auto move = for_alfa<M>();
  for (const auto& [command, kind] : kKinds) {
    move.command = command;
    EXPECT_EQ(decode_order(on("OLS_PTU_alfa", move)).value().kind, kind);
  }
  move.command = M::COMMAND_RATE;
  EXPECT_FALSE(decode_order(on("OLS_PTU_alfa", move))) << "a joystick's come ten times a second";
}

TEST(HeardReply, IsToOneOrderAndFromTheStationOfItsChannelOrTheFusion) {
  auto said = for_alfa<ols_msg::command_reply_t>();
  said.order_boot_id = 5;
  said.order_sequence = 9;
  said.reason = "precedence";
  said.detail = "a\x1b";
  const auto reply = decode_reply(on("OLS_REPLY_alfa", said));
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->station, "alfa");
  EXPECT_EQ(reply->order, (OrderId{5, 9}));
  EXPECT_FALSE(reply->is_accepted || reply->is_stopped);
  EXPECT_EQ(refusal_in_words(*reply),
            "refused: an operator has control, or has stopped it; release the station first: a?");
  EXPECT_FALSE(decode_reply(on("OLS_REPLY_bravo", said)));
  EXPECT_FALSE(decode_reply(on("OLS_CUE_REPLY", said)))
      << "a station does not speak for the fusion";
  said.station = "";
  EXPECT_FALSE(decode_reply(on("OLS_REPLY_", said)));
  EXPECT_EQ(decode_reply(on("OLS_CUE_REPLY", said))->station, "");
}

TEST(HeardOrder, IsForTheStationOfItsChannelAndOfAKnownKind) {
  auto move = for_alfa<ols_msg::ptu_command_t>();
  EXPECT_FALSE(decode_order(on("OLS_PTU_bravo", move)));
  EXPECT_FALSE(decode_order(on("OLS_STATUS_alfa", move)));
  move.command = 99;
  EXPECT_FALSE(decode_order(on("OLS_PTU_alfa", move)));
}

TEST(OrderSender, NumbersItsWordsOnCues) {
  LcmBus bus("memq://");
  std::vector<ols_msg::cue_order_t> heard;
  bus.subscribe("OLS_CUE_ORDER", [&heard](const BusMessage& message) {
    ols_msg::cue_order_t order;
    if (decode_of_schema(message, order)) heard.push_back(order);
  });
  OrderSender sender(17);
  sender.send(bus, {"tak.anna", true, sender.next_id()}, 1'000);
  sender.send(bus, {"tak.anna", false, sender.next_id()}, 2'000);
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
}  // namespace ols::wire
