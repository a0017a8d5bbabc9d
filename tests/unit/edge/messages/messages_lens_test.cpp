#include "edge/messages/messages_lens.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ols::station {
namespace {

TEST(LensMessages, AnAxisThatIsNotNamedIsNotCommanded) {
  ols_msg::lens_command_t message{};
  message.command = ols_msg::lens_command_t::COMMAND_RATE;
  message.zoom = -0.5;
  message.focus = message.iris = std::nan("");
  message.lease_s = 0.3;
  const LensCommand command = from_message(message, 7.0);
  EXPECT_TRUE(command.is_rate);
  EXPECT_EQ(command.values.zoom, -0.5);
  EXPECT_FALSE(command.values.focus);
  EXPECT_FALSE(command.values.iris);
  EXPECT_EQ(command.received_s, 7.0);
}

TEST(LensMessages, WhatIsNotKnownOfTheLensIsNotANumber) {
  StationSnapshot snapshot;
  snapshot.overview = true;
  snapshot.lens.zoom = 0.25;
  ols_msg::station_status_t message{};
  fill_lens(snapshot, message);
  EXPECT_EQ(message.kind, +ols_msg::station_status_t::KIND_OVERVIEW);
  EXPECT_EQ(message.lens_position[0], 0.25);
  EXPECT_TRUE(std::isnan(message.lens_position[1]));
  EXPECT_TRUE(std::isnan(message.focal_length_px));
  EXPECT_TRUE(std::isnan(message.focal_length_sd_px));
}

}  // namespace
}  // namespace ols::station
