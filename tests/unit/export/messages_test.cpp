#include "export/messages.h"

#include <gtest/gtest.h>

#include "geometry/angles.h"
#include "geometry/wgs84.h"
#include "tests/unit/export/made_messages.h"

namespace ols::exports {
namespace {

const SiteContext kSite{"brno", [](double, double) { return 46.0; }};

TEST(ExportMessages, ATargetInDegreesWithItsVelocityTurned) {
  auto message = target_message();
  const auto target = target_from(on("OLS_TARGET", message), kSite);
  ASSERT_TRUE(target);
  EXPECT_EQ(target->uid, "brno.target.0000000000000003.7");
  EXPECT_DOUBLE_EQ(target->place.above_sea_m(), 54.0);
  EXPECT_NEAR(target->velocity_enu_m_s[0], 5.0, 1e-9);  // ECEF y is east at longitude 0
  EXPECT_EQ(target->stations, (std::vector<std::string>{"alfa"}));
}

TEST(ExportMessages, ATargetOfNoOtherChannel) {
  auto message = target_message();
  EXPECT_FALSE(target_from(on("OLS_TARGET_PAPER", message), kSite));
  EXPECT_FALSE(target_from(on("OLS_STATUS_alfa", message), kSite));
}

TEST(ExportMessages, AnIncidentNamesItsTargetAsTheTargetIsNamed) {
  const auto incident = incident_from(on("OLS_INCIDENT", incident_message()), kSite);
  ASSERT_TRUE(incident);
  EXPECT_EQ(incident->target_uid, "brno.target.0000000000000003.7");
  EXPECT_EQ(incident->uid, "brno.incident.3." + std::to_string(kNow_us));
  EXPECT_EQ(incident->verdict, "dismissed");
  EXPECT_EQ(incident->judged_by, "ana?");
  EXPECT_TRUE(incident->is_inside());
  EXPECT_FALSE(incident->is_alarm());
  auto nowhere = incident_message();
  nowhere.height_m = std::nan("");
  EXPECT_FALSE(incident_from(on("OLS_INCIDENT", nowhere), kSite));
  EXPECT_FALSE(incident_from(on("OLS_INCIDENTS", incident_message()), kSite));
}

TEST(ExportMessages, AHeightAboveTheGroundMayBeZeroOrUnknown) {
  auto message = target_message();
  EXPECT_TRUE(std::isnan(target_from(on("OLS_TARGET", message), kSite)->above_ground_m));
  message.has_height_above_ground = 1;
  EXPECT_EQ(target_from(on("OLS_TARGET", message), kSite)->above_ground_m, 0.0);
}

TEST(ExportMessages, WithoutAPositionThereIsNoTarget) {
  auto message = target_message();
  message.solution = ols_msg::target_t::SOLUTION_TOO_FEW_RAYS;
  EXPECT_FALSE(target_from(on("OLS_TARGET", message), kSite));
  message = target_message();
  message.latitude_deg = std::nan("");
  EXPECT_FALSE(target_from(on("OLS_TARGET", message), kSite));
  message.track_state = ols_msg::target_t::TRACK_DROPPED;
  const auto end = target_from(on("OLS_TARGET", message), kSite);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->state, TrackState::kEnded);
}

TEST(ExportMessages, AStationOfItsChannel) {
  auto message = status_message();
  const auto station = station_from(on("OLS_STATUS_alfa", message), kSite);
  ASSERT_TRUE(station);
  EXPECT_EQ(station->state, "tracking");
  EXPECT_NEAR(station->azimuth_deg, 57.2958, 1e-4);
  EXPECT_FALSE(station->is_well);
  EXPECT_FALSE(station_from(on("OLS_STATUS_bravo", message), kSite));
  message.latitude_deg = std::nan("");
  EXPECT_FALSE(station_from(on("OLS_STATUS_alfa", message), kSite));
}

TEST(ExportMessages, ALineFromItsCamera) {
  auto message = bearing_message();
  const auto line = line_from(on("OLS_BEARING_alfa", message), kSite);
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->camera.latitude_deg, 47.4, 1e-9);
  EXPECT_NEAR(line->camera.height_m, 601.0, 1e-6);
  EXPECT_NEAR(line->cross_sd_deg, degrees(5e-4), 1e-12);
  message.detected = 1;
  EXPECT_FALSE(line_from(on("OLS_BEARING_alfa", message), kSite)) << "no target yet";
  message.detected = 0;
  message.azimuth_rad = std::nan("");
  EXPECT_FALSE(line_from(on("OLS_BEARING_alfa", message), kSite));
}

TEST(ExportMessages, RubbishIsNotUnderstood) {
  BusMessage message = on("OLS_TARGET", target_message());
  EXPECT_TRUE(is_understood(message));
  message.payload.pop_back();
  EXPECT_FALSE(is_understood(message));
  EXPECT_FALSE(target_from(message, kSite));
  auto later = target_message();
  ++later.schema_version;
  EXPECT_FALSE(is_understood(on("OLS_TARGET", later)));
}

}  // namespace
}  // namespace ols::exports
