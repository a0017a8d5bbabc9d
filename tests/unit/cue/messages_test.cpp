#include "cue/messages.h"

#include <gtest/gtest.h>

namespace ols::cues {
namespace {

TEST(CueMessages, CarryTheWholeCue) {
  const LiveCue cue{.id = "tak.a",
                    .label = "Anna",
                    .utime_us = 5,
                    .latitude_deg = 49.0,
                    .longitude_deg = 16.0,
                    .height_m = 400.0,
                    .horizontal_sd_m = 3.0,
                    .vertical_sd_m = 4.0,
                    .velocity_enu_m_s = {1.0, 2.0, 3.0},
                    .velocity_sd_m_s = 0.5};
  const auto message = to_message(cue, {.utime_us = 7, .boot_id = 8, .sequence = 9});
  EXPECT_EQ(message.schema_version, ols_msg::cue_t::SCHEMA_VERSION);
  EXPECT_EQ(message.utime, 7);
  EXPECT_EQ(message.boot_id, 8);
  EXPECT_EQ(message.sequence, 9);
  EXPECT_EQ(message.id, "tak.a");
  EXPECT_EQ(message.label, "Anna");
  EXPECT_EQ(message.state_utime, 5);
  EXPECT_EQ(message.latitude_deg, 49.0);
  EXPECT_EQ(message.longitude_deg, 16.0);
  EXPECT_EQ(message.height_m, 400.0);
  EXPECT_EQ(message.horizontal_sd_m, 3.0);
  EXPECT_EQ(message.vertical_sd_m, 4.0);
  EXPECT_EQ(message.velocity_enu_m_s[2], 3.0);
  EXPECT_EQ(message.velocity_sd_m_s, 0.5);
}

}  // namespace
}  // namespace ols::cues
