#include "bridge/messages.h"

#include <gtest/gtest.h>

#include <limits>

#include "bridge_messages.h"
#include "ols_msg/occlusion_t.hpp"

namespace ols::bridge {
namespace {

ols_msg::target_t placed() {
  ols_msg::target_t message{};
  message.target_id = 5;
  message.track_state = ols_msg::target_t::TRACK_CONFIRMED;
  message.position_ecef_m[0] = 4e6;
  message.velocity_ecef_m_s[1] = 7.0;
  message.latitude_deg = 49.0;
  message.longitude_deg = 16.0;
  message.position_covariance_enu_m2[0] = 4.0;
  message.position_covariance_enu_m2[3] = 4.0;
  message.position_covariance_enu_m2[5] = 1.0;
  return message;
}

TEST(BridgeMessages, ATargetsPlaceIsRead) {
  const auto track = track_from(encoded(placed()));
  ASSERT_TRUE(track);
  EXPECT_EQ(track->id, 5);
  EXPECT_EQ(track->position_m[0], 4e6);
  EXPECT_EQ(track->velocity_m_s[1], 7.0);
  EXPECT_EQ(track->sd_m, 3.0);
  EXPECT_EQ(track->latitude_deg, 49.0);
}

TEST(BridgeMessages, WhatHasNoPlaceIsNoTrack) {
  ols_msg::target_t message = placed();
  message.target_id = 0;
  EXPECT_FALSE(track_from(encoded(message)));
  message = placed();
  message.solution = ols_msg::target_t::SOLUTION_BEARING_ONLY;
  EXPECT_FALSE(track_from(encoded(message)));
  message = placed();
  message.track_state = ols_msg::target_t::TRACK_DROPPED;
  EXPECT_FALSE(track_from(encoded(message)));
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), 1e300}) {
    message = placed();
    message.position_ecef_m[1] = bad;
    EXPECT_FALSE(track_from(encoded(message)));
    message = placed();
    message.latitude_deg = bad;
    EXPECT_FALSE(track_from(encoded(message)));
  }
  EXPECT_FALSE(track_from(std::vector<std::uint8_t>(20)));
}

TEST(BridgeMessages, AnOwnerSaysWhereItsTargetIsAndUnderWhichEpoch) {
  const Headers headers{
      {kTargetHeader, "west=7-1"}, {kOwnerHeader, "west=7"}, {kEpochHeader, "41"}};
  const auto sighting = sighting_from(headers, encoded(placed()));
  ASSERT_TRUE(sighting);
  EXPECT_EQ(sighting->target, "west=7-1");
  EXPECT_EQ(sighting->epoch, 41U);
  EXPECT_EQ(sighting->position_m[0], 4e6);
  EXPECT_EQ(sighting->sd_m, 3.0);
  EXPECT_FALSE(sighting_from({}, encoded(placed()))) << "of a fusion without ownership";
  EXPECT_FALSE(sighting_from({{kTargetHeader, "w"}, {kEpochHeader, "x"}}, encoded(placed())));
  EXPECT_FALSE(sighting_from(headers, std::vector<std::uint8_t>(20)));
}

TEST(BridgeMessages, AMessageNamesItsTarget) {
  EXPECT_EQ(target_id_of(Kind::kTarget, target(8)), 8);
  EXPECT_EQ(target_id_of(Kind::kCommand, slew("alfa", 0.0, 9)), 9);
  ols_msg::occlusion_t occlusion{};
  occlusion.target_id = 10;
  EXPECT_EQ(target_id_of(Kind::kCommand, encoded(occlusion)), 10);
  EXPECT_EQ(target_id_of(Kind::kCommand, target(8)), std::nullopt);
  EXPECT_EQ(target_id_of(Kind::kTarget, {}), std::nullopt);
}

}  // namespace
}  // namespace ols::bridge
