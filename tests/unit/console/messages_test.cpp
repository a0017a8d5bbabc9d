#include "console/messages.h"

#include <gtest/gtest.h>

#include <limits>

#include "conditions/alarms.h"
#include "ols_msg/bearing_t.hpp"
#include "ols_msg/fusion_status_t.hpp"
#include "ols_msg/occlusion_t.hpp"
#include "ols_msg/skyline_t.hpp"
#include "ols_msg/station_status_t.hpp"
#include "ols_msg/target_t.hpp"
#include "tests/unit/on_the_bus.h"

namespace ols::console {
namespace {

TEST(ConsoleMessages, AStatusInDegreesWithNullForTheUnknown) {
  auto status = made<ols_msg::station_status_t>();
  status.station = "alfa";
  status.state = ols_msg::station_status_t::STATE_TRACKING;
  status.azimuth_rad = 1.0;
  status.heading_rad = std::numeric_limits<double>::quiet_NaN();
  set_alarms({{"camera: \x1b[2J"}, alarm::ptu_supply_low(11.2)}, status);
  const auto heard = station_from(on("OLS_STATUS_alfa", status));
  ASSERT_TRUE(heard);
  EXPECT_EQ(heard->id, "alfa");
  EXPECT_EQ(heard->fields.at("state"), "tracking");
  EXPECT_NEAR(heard->fields.at("azimuth_deg"), 57.2958, 1e-9);
  EXPECT_TRUE(heard->fields.at("heading_deg").is_null());
  EXPECT_EQ(heard->alarms.at(0).text, "camera: ?[2J");
  EXPECT_EQ(heard->fields.at("alarms")[0].at("key"), "camera: ?[2J");
  EXPECT_EQ(heard->fields.at("alarms")[1].at("key"), "ptu_supply_low");
  EXPECT_EQ(heard->fields.at("alarms")[1].at("parameters").at("volts"), "11.2");
  EXPECT_FALSE(station_from(on("OLS_STATUS_bravo", status)));
}

ols_msg::target_t target() {
  auto message = made<ols_msg::target_t>();
  message.target_id = 3;
  message.track_state = ols_msg::target_t::TRACK_CONFIRMED;
  message.latitude_deg = 0.0;
  message.longitude_deg = 0.0;
  message.velocity_ecef_m_s[1] = 5.0;  // east, at 0, 0
  message.position_covariance_enu_m2[0] = 4.0;
  message.position_covariance_enu_m2[3] = 1.0;
  message.position_covariance_enu_m2[5] = 9.0;
  return message;
}

TEST(ConsoleMessages, ATargetHasItsVelocityInTheHorizonAndItsEllipse) {
  const auto heard = target_from(on("OLS_TARGET", target()));
  ASSERT_TRUE(heard);
  EXPECT_EQ(heard->what, ReceivedTarget::What::kPosition);
  EXPECT_EQ(heard->id, "3");
  EXPECT_NEAR(heard->fields.at("velocity_enu_m_s")[0], 5.0, 1e-9);
  EXPECT_NEAR(heard->fields.at("course_deg"), 90.0, 1e-9);
  EXPECT_NEAR(heard->fields.at("ellipse95").at("azimuth_deg"), 90.0, 1e-9);
  EXPECT_EQ(heard->fields.at("sd_enu_m"), Json::parse("[2.0,1.0,3.0]"));
  EXPECT_EQ(heard->fields.at("height_above_ground_m"), nullptr);
  auto known = target();
  known.has_height_above_ground = 1;
  EXPECT_EQ(target_from(on("OLS_TARGET", known))->fields.at("height_above_ground_m"), 0.0);
}

TEST(ConsoleMessages, WhatIsNoPositionIsNoPosition) {
  auto message = target();
  message.solution = ols_msg::target_t::SOLUTION_RAYS_MISS;
  EXPECT_EQ(target_from(on("OLS_TARGET", message))->what, ReceivedTarget::What::kNoPosition);
  message.solution = ols_msg::target_t::SOLUTION_OK;
  message.latitude_deg = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(target_from(on("OLS_TARGET", message))->what, ReceivedTarget::What::kNoPosition);
  message.track_state = ols_msg::target_t::TRACK_DROPPED;
  EXPECT_EQ(target_from(on("OLS_TARGET", message))->what, ReceivedTarget::What::kDropped);
  message.target_id = 0;
  EXPECT_EQ(target_from(on("OLS_TARGET", message))->what, ReceivedTarget::What::kNothing);
  message.solution = ols_msg::target_t::SOLUTION_BEARING_ONLY;
  EXPECT_FALSE(target_from(on("OLS_TARGET", message))) << "of no station";
  message.stations = 1;
  message.station = {"alfa"};
  message.used = {1};
  message.weight = {1.0};
  message.age_s = {0.0};
  EXPECT_EQ(target_from(on("OLS_TARGET", message))->what, ReceivedTarget::What::kLine);
  EXPECT_EQ(target_from(on("OLS_TARGET", message))->id, "alfa");
}

TEST(ConsoleMessages, OfOtherChannelsThereIsNoTargetAndNoFusion) {
  EXPECT_FALSE(target_from(on("OLS_TARGET_PAPER", target())));
  EXPECT_FALSE(fusion_from(on("OLS_FUSION_STATUS_2", made<ols_msg::fusion_status_t>())));
}

TEST(ConsoleMessages, WhatTheLandHidesFromAStation) {
  auto message = made<ols_msg::occlusion_t>();
  message.station = "alfa";
  message.target_id = 7;
  message.hidden = 0.9;
  message.utime = 5;
  message.exit_utime = 6;
  message.holds_s = 2.0;
  const auto heard = occlusion_from(on("OLS_OCCLUSION_alfa", message));
  ASSERT_TRUE(heard);
  EXPECT_EQ(heard->target, "7");
  EXPECT_TRUE(heard->is_hidden);
  EXPECT_EQ(heard->back_us, 6);
  message.hidden = 0.2;
  EXPECT_FALSE(occlusion_from(on("OLS_OCCLUSION_alfa", message))->is_hidden);
  EXPECT_FALSE(occlusion_from(on("OLS_OCCLUSION_bravo", message)));
}

TEST(ConsoleMessages, WhereAPictureDisagreesWithTheLand) {
  auto message = made<ols_msg::skyline_t>();
  message.station = "alfa";
  message.begun_utime = 5;
  message.sector = 71;
  message.columns = 2;
  message.column = {7100, 7199};
  message.elevation_rad = {0.125F, 0.25F};
  message.sd_rad = message.hides_from_m = {1.0F, 1.0F};
  message.disagrees = {0, 1};
  const auto heard = skyline_from(on("OLS_SKYLINE_alfa", message));
  ASSERT_TRUE(heard);
  EXPECT_EQ(heard->begun_us, 5);
  EXPECT_EQ(heard->sector, 71);
  EXPECT_EQ(heard->differing, (std::vector<std::pair<int, double>>{{7199, 0.25}}));
  EXPECT_FALSE(skyline_from(on("OLS_SKYLINE_bravo", message)));
  message.column[0] = 7199;
  EXPECT_FALSE(skyline_from(on("OLS_SKYLINE_alfa", message))) << "twice the same";
}

TEST(ConsoleMessages, ABearingIsOfTheStationOfItsChannel) {
  auto bearing = made<ols_msg::bearing_t>();
  bearing.station = "alfa";
  bearing.azimuth_rad = 1.0;
  EXPECT_EQ(bearing_from(on("OLS_BEARING_alfa", bearing))->first, "alfa");
  EXPECT_FALSE(bearing_from(on("OLS_BEARING_bravo", bearing)));
  bearing.detected = 1;
  EXPECT_FALSE(bearing_from(on("OLS_BEARING_alfa", bearing))) << "of an object it does not follow";
  bearing.detected = 0;
  ++bearing.schema_version;
  EXPECT_FALSE(bearing_from(on("OLS_BEARING_alfa", bearing)));
}

TEST(ConsoleMessages, TheFusionsStatus) {
  auto status = made<ols_msg::fusion_status_t>();
  status.boot_id = 9;
  status.last_error = "x\ny";
  const auto heard = fusion_from(on("OLS_FUSION_STATUS", status));
  ASSERT_TRUE(heard);
  EXPECT_EQ(heard->boot_id, 9);
  EXPECT_EQ(heard->last_error, "x?y");
}

TEST(ConsoleMessages, WhereAStationsVideoIsToBeHad) {
  auto status = made<ols_msg::station_status_t>();
  status.station = "alfa";
  status.devices = 1;
  status.device_name = {"video"};
  status.device_state = {ols_msg::station_status_t::DEVICE_OK};
  status.device_text = {"10.0.0.11:7790"};
  status.device_age_s = {0.0};
  EXPECT_EQ(station_from(on("OLS_STATUS_alfa", status))->video_address, "10.0.0.11:7790");
  status.device_state = {ols_msg::station_status_t::DEVICE_ABSENT};
  EXPECT_EQ(station_from(on("OLS_STATUS_alfa", status))->video_address, "");
}

}  // namespace
}  // namespace ols::console
