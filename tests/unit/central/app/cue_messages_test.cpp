#include <gtest/gtest.h>

#include "central/app/messages.h"
#include "geometry/angles.h"
#include "ols_msg/cue_order_t.hpp"
#include "ols_msg/cue_t.hpp"
#include "tests/unit/on_the_bus.h"

namespace ols::fusion {
namespace {

using Bytes = std::vector<std::uint8_t>;

TEST(CueMessages, ACueIsRead) {
  auto cue = made<ols_msg::cue_t>();
  cue.utime = 5;
  cue.state_utime = 4;
  cue.id = "tak.a\n";
  cue.latitude_deg = 49.0;
  cue.longitude_deg = 16.0;
  cue.height_m = 400.0;
  cue.horizontal_sd_m = 3.0;
  cue.vertical_sd_m = 4.0;
  cue.velocity_enu_m_s[1] = 2.0;
  cue.velocity_sd_m_s = 0.5;
  const auto read = [](const Bytes& bytes) {
    return cue_from(bytes.data(), static_cast<int>(bytes.size()));
  };
  const auto decoded = read(encoded(cue));
  ASSERT_TRUE(std::holds_alternative<Cue>(decoded));
  const Cue& heard = std::get<Cue>(decoded);
  EXPECT_EQ(heard.id.find('\n'), std::string::npos) << "nothing that a terminal obeys";
  EXPECT_EQ(heard.utime_us, 5);
  EXPECT_EQ(heard.state_us, 4);
  EXPECT_NEAR(degrees(heard.place.latitude_rad), 49.0, 1e-9);
  EXPECT_EQ(heard.horizontal_sd_m, 3.0);
  EXPECT_EQ(heard.vertical_sd_m, 4.0);
  EXPECT_EQ(heard.velocity_enu_m_s.y(), 2.0);
  EXPECT_EQ(heard.velocity_sd_m_s, 0.5);
  cue.id.assign(101, 'x');
  EXPECT_EQ(std::get<MessageRefusal>(read(encoded(cue))), MessageRefusal::kMalformed);
  cue.id = "12";
  EXPECT_EQ(std::get<MessageRefusal>(read(encoded(cue))), MessageRefusal::kMalformed) << "a target";
  ++cue.schema_version;
  EXPECT_EQ(std::get<MessageRefusal>(read(encoded(cue))), MessageRefusal::kSchema);
  EXPECT_EQ(std::get<MessageRefusal>(read({})), MessageRefusal::kMalformed);
}

TEST(CueMessages, AnOperatorsWordOnACueIsRead) {
  auto order = made<ols_msg::cue_order_t>();
  order.cue = "tak.a";
  order.allow = 1;
  order.utime = 9;
  order.lease_s = 2.0;
  order.sequence = 3;
  const auto word = [](const Bytes& bytes) {
    return cue_order_from(bytes.data(), static_cast<int>(bytes.size()));
  };
  const auto said = word(encoded(order));
  ASSERT_TRUE(std::holds_alternative<CueOrder>(said));
  EXPECT_EQ(std::get<CueOrder>(said).cue, "tak.a");
  EXPECT_TRUE(std::get<CueOrder>(said).allow);
  EXPECT_EQ(std::get<CueOrder>(said).utime_us, 9);
  EXPECT_EQ(std::get<CueOrder>(said).sequence, 3);
  EXPECT_FALSE(std::get<CueOrder>(said).handover);
  order.handover = "propose";
  EXPECT_EQ(std::get<CueOrder>(word(encoded(order))).handover, HandoverMode::kPropose);
  order.handover = "on";
  EXPECT_EQ(std::get<MessageRefusal>(word(encoded(order))), MessageRefusal::kOutOfRange);
  order.handover = {};
  order.lease_s = std::nan("");
  EXPECT_EQ(std::get<MessageRefusal>(word(encoded(order))), MessageRefusal::kOutOfRange);
}

}  // namespace
}  // namespace ols::fusion
