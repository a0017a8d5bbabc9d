#include "base/trust/message_head.h"

#include <gtest/gtest.h>

#include "ols_msg/bearing_t.hpp"
#include "ols_msg/cue_order_t.hpp"
#include "ols_msg/cue_t.hpp"
#include "ols_msg/frame_part_t.hpp"
#include "ols_msg/fusion_status_t.hpp"
#include "ols_msg/occlusion_t.hpp"
#include "ols_msg/preview_t.hpp"
#include "ols_msg/procedure_answer_t.hpp"
#include "ols_msg/procedure_t.hpp"
#include "ols_msg/ptu_command_t.hpp"
#include "ols_msg/record_t.hpp"
#include "ols_msg/sighting_t.hpp"
#include "ols_msg/site_settings_t.hpp"
#include "ols_msg/skyline_t.hpp"
#include "ols_msg/slew_t.hpp"
#include "ols_msg/station_status_t.hpp"
#include "ols_msg/target_t.hpp"
#include "ols_msg/trust_list_t.hpp"
#include "tests/unit/base/trust/site_fixture.h"
#include "tests/unit/on_the_bus.h"

namespace ols::trust {
namespace {

template <class Message>
void expect_head(HeadForm form) {
  Message message{};
  message.utime = -5;
  message.boot_id = 0x123456789abcdef0;
  message.sequence = 77;
  if constexpr (requires { message.station.empty(); }) {
    if constexpr (std::is_same_v<decltype(message.station), std::string>) message.station = "alfa";
  }
  const auto bytes = encoded(message);
  const auto head = read_head(bytes, form);
  ASSERT_TRUE(head) << Message::getTypeName();
  EXPECT_EQ(head->utime_us, -5) << Message::getTypeName();
  EXPECT_EQ(head->boot_id, 0x123456789abcdef0) << Message::getTypeName();
  EXPECT_EQ(head->sequence, 77) << Message::getTypeName();
  EXPECT_EQ(head->station, form == HeadForm::kStationFirst ? "alfa" : "") << Message::getTypeName();
}

TEST(MessageHead, IsThatOfEachType) {
  expect_head<ols_msg::bearing_t>(HeadForm::kStationFirst);
  expect_head<ols_msg::station_status_t>(HeadForm::kStationFirst);
  expect_head<ols_msg::preview_t>(HeadForm::kStationFirst);
  expect_head<ols_msg::frame_part_t>(HeadForm::kStationFirst);
  expect_head<ols_msg::sighting_t>(HeadForm::kStationFirst);
  expect_head<ols_msg::skyline_t>(HeadForm::kStationFirst);
  expect_head<ols_msg::procedure_t>(HeadForm::kStationFirst);
  expect_head<ols_msg::occlusion_t>(HeadForm::kBootFirst);
  expect_head<ols_msg::slew_t>(HeadForm::kBootFirst);
  expect_head<ols_msg::ptu_command_t>(HeadForm::kBootFirst);
  expect_head<ols_msg::record_t>(HeadForm::kBootFirst);
  expect_head<ols_msg::procedure_answer_t>(HeadForm::kBootFirst);
  expect_head<ols_msg::target_t>(HeadForm::kBootFirst);
  expect_head<ols_msg::fusion_status_t>(HeadForm::kBootFirst);
  expect_head<ols_msg::cue_t>(HeadForm::kBootFirst);
  expect_head<ols_msg::cue_order_t>(HeadForm::kBootFirst);
  expect_head<ols_msg::trust_list_t>(HeadForm::kBootFirst);
  expect_head<ols_msg::site_settings_t>(HeadForm::kBootFirst);
}

TEST(MessageHead, AnythingTooShortHasNone) {
  for (const char* station : {"", "alfa"}) {
    const auto form = station[0] == 0 ? HeadForm::kBootFirst : HeadForm::kStationFirst;
    const auto whole = payload(1, 2, 3, station);
    const std::size_t head = whole.size() - 40;
    EXPECT_TRUE(read_head(Bytes(whole).first(head), form));
    for (std::size_t size = 0; size < head; ++size) {
      EXPECT_FALSE(read_head(Bytes(whole).first(size), form)) << size;
    }
  }
}

TEST(MessageHead, AStationsNameOfAnAbsurdLengthIsRefused) {
  for (const std::uint8_t length : {0, 0x7f, 0xff}) {
    auto bytes = payload(1, 2, 3, "alfa");
    for (std::size_t i = 20; i < 24; ++i) bytes[i] = length;
    EXPECT_FALSE(read_head(bytes, HeadForm::kStationFirst)) << int{length};
  }
}

}  // namespace
}  // namespace ols::trust
