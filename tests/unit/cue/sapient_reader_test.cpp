#include "cue/sapient_reader.h"

#include <gtest/gtest.h>

#include <cmath>

#include "export/sapient/frame.h"
#include "export/sapient/sapient_messages.h"
#include "geometry/angles.h"
#include "geometry/utm.h"
#include "sapient/sapient.pb.h"
#include "tests/unit/export/made_records.h"

namespace ols::cues {
namespace {

namespace sapient = exports::sapient;

constexpr std::int64_t kTime_us = 1'795'428'930'250'000;
const GeoidHeight kGeoid = [](double, double) { return 46.0; };

sapient::SapientMessage message_of_node() {
  sapient::SapientMessage message;
  message.mutable_timestamp()->set_seconds(kTime_us / 1'000'000);
  message.mutable_timestamp()->set_nanos(250'000'000);
  message.set_node_id("radar");
  return message;
}

sapient::SapientMessage detection() {
  auto message = message_of_node();
  auto& report = *message.mutable_detection_report();
  report.set_object_id("01ARYZ6S41TSV4RRFFQ69G5FAV");
  auto& place = *report.mutable_location();
  place.set_x(16.6);
  place.set_y(49.2);
  place.set_z(410.5);
  place.set_coordinate_system(sapient::LOCATION_COORDINATE_SYSTEM_LAT_LNG_DEG_M);
  place.set_datum(sapient::LOCATION_DATUM_WGS84_E);
  return message;
}

sapient::Location& place_in(sapient::SapientMessage& message) {
  return *message.mutable_detection_report()->mutable_location();
}

Reading read(const sapient::SapientMessage& message, const GeoidHeight& geoid_m = kGeoid) {
  SapientReader reader(geoid_m);
  return reader.take(message.SerializeAsString()).at(0);
}

Report report_of(const Reading& reading) {
  const auto* found = std::get_if<Report>(&reading);
  if (found != nullptr) return *found;
  ADD_FAILURE() << to_string(std::get<Refused>(reading).why);
  return {};
}

Refusal refusal(const Reading& reading) {
  const auto* found = std::get_if<Refused>(&reading);
  return found == nullptr ? Refusal::kCount : found->why;
}

TEST(SapientReader, ADetectionIsRead) {
  auto message = detection();
  auto& velocity = *message.mutable_detection_report()->mutable_enu_velocity();
  velocity.set_east_rate(3.0);
  velocity.set_north_rate(-4.0);
  velocity.set_east_rate_error(0.5);
  velocity.set_north_rate_error(0.75);
  message.mutable_detection_report()->add_classification()->set_type("Air Vehicle");
  const Report found = report_of(read(message));
  EXPECT_EQ(found.name, "01ARYZ6S41TSV4RRFFQ69G5FAV");
  EXPECT_EQ(found.label, "Air Vehicle");
  EXPECT_EQ(found.utime_us, kTime_us);
  EXPECT_DOUBLE_EQ(found.latitude_deg, 49.2);
  EXPECT_DOUBLE_EQ(found.longitude_deg, 16.6);
  EXPECT_DOUBLE_EQ(found.height_m, 410.5);
  EXPECT_FALSE(found.horizontal_sd_m || found.vertical_sd_m);
  EXPECT_EQ(found.velocity_enu_m_s, (std::array{3.0, -4.0, 0.0}));
  EXPECT_EQ(found.velocity_sd_m_s, 0.75);
}

TEST(SapientReader, DeviationsAreInDegreesOrInMetres) {
  auto message = detection();
  place_in(message).set_x_error(1e-4);
  place_in(message).set_y_error(5e-5);
  place_in(message).set_z_error(12.0);
  const Report in_degrees = report_of(read(message));
  EXPECT_NEAR(*in_degrees.horizontal_sd_m, 11.12 * std::cos(radians(49.2)), 0.05);
  EXPECT_EQ(in_degrees.vertical_sd_m, 12.0);
  place_in(message).set_x_error(20.0);
  place_in(message).set_y_error(15.0);
  EXPECT_EQ(report_of(read(message)).horizontal_sd_m, 20.0);
  place_in(message).set_x_error(0.02);
  place_in(message).set_y_error(0.02);
  EXPECT_GT(report_of(read(message)).horizontal_sd_m, 2000.0) << "never surer than its sensor";
}

TEST(SapientReader, AHeightAboveTheGeoidNeedsOne) {
  auto message = detection();
  place_in(message).set_datum(sapient::LOCATION_DATUM_WGS84_G);
  EXPECT_DOUBLE_EQ(report_of(read(message)).height_m, 456.5);
  EXPECT_EQ(refusal(read(message, {})), Refusal::kNoHeight);
  EXPECT_EQ(refusal(read(message, [](double, double) { return NAN; })), Refusal::kNoHeight);
  place_in(message).clear_z();
  EXPECT_EQ(refusal(read(message)), Refusal::kNoHeight);
}

TEST(SapientReader, PlacesInRadiansAndOnTheGridAreTheSame) {
  auto message = detection();
  place_in(message).set_x(radians(16.6));
  place_in(message).set_y(radians(49.2));
  place_in(message).set_coordinate_system(sapient::LOCATION_COORDINATE_SYSTEM_LAT_LNG_RAD_M);
  EXPECT_NEAR(report_of(read(message)).longitude_deg, 16.6, 1e-12);
  const UtmPoint grid = utm_from_geodetic({radians(49.2), radians(16.6), 0.0});
  place_in(message).set_x(grid.position.easting_m);
  place_in(message).set_y(grid.position.northing_m);
  place_in(message).set_x_error(8.0);
  place_in(message).set_y_error(9.0);
  place_in(message).set_utm_zone("33U");
  place_in(message).set_coordinate_system(sapient::LOCATION_COORDINATE_SYSTEM_UTM_M);
  const Report found = report_of(read(message));
  EXPECT_NEAR(found.latitude_deg, 49.2, 1e-9);
  EXPECT_EQ(found.horizontal_sd_m, 9.0);
  place_in(message).set_utm_zone("33N");
  EXPECT_NEAR(report_of(read(message)).latitude_deg, 49.2, 1e-9);
  place_in(message).set_utm_zone("33S");
  EXPECT_LT(report_of(read(message)).latitude_deg, 0.0);
  for (const char* zone : {"", "33", "33-", "U", "333U"}) {
    place_in(message).set_utm_zone(zone);
    EXPECT_NE(refusal(read(message)), Refusal::kCount) << zone;
  }
}

sapient::SapientMessage node_status() {
  auto message = message_of_node();
  auto& place = *message.mutable_status_report()->mutable_node_location();
  place = detection().detection_report().location();
  return message;
}

sapient::SapientMessage sight() {
  auto message = detection();
  auto& bearing = *message.mutable_detection_report()->mutable_range_bearing();
  bearing.set_azimuth(90.0);
  bearing.set_elevation(0.0);
  bearing.set_range(2.0);
  bearing.set_azimuth_error(1.0);
  bearing.set_range_error(0.01);
  bearing.set_elevation_error(0.5);
  bearing.set_coordinate_system(sapient::RANGE_BEARING_COORDINATE_SYSTEM_DEGREES_KM);
  bearing.set_datum(sapient::RANGE_BEARING_DATUM_TRUE);
  return message;
}

TEST(SapientReader, ABearingWithARangeCountsFromItsNode) {
  SapientReader reader(kGeoid);
  EXPECT_EQ(refusal(reader.take(sight().SerializeAsString()).at(0)), Refusal::kOtherType);
  EXPECT_TRUE(reader.take(node_status().SerializeAsString()).empty());
  const Report found = report_of(reader.take(sight().SerializeAsString()).at(0));
  EXPECT_NEAR(found.latitude_deg, 49.2, 1e-5);
  EXPECT_NEAR((found.longitude_deg - 16.6) * 111'320.0 * std::cos(radians(49.2)), 2000.0, 8.0);
  EXPECT_NEAR(found.height_m, 410.5 + 2000.0 * 2000.0 / (2.0 * 6.37e6), 0.01);
  EXPECT_NEAR(*found.horizontal_sd_m, radians(1.0) * 2000.0, 1e-6);
  EXPECT_NEAR(*found.vertical_sd_m, radians(0.5) * 2000.0, 1e-6);
  auto blind = sight();
  blind.mutable_detection_report()->mutable_range_bearing()->clear_range();
  EXPECT_EQ(refusal(reader.take(blind.SerializeAsString()).at(0)), Refusal::kOtherType);
}

TEST(SapientReader, AGridsZoneIsThatOfTheRegistrationUnlessSaid) {
  SapientReader reader(kGeoid);
  auto registration = message_of_node();
  registration.mutable_registration()
      ->add_mode_definition()
      ->add_detection_definition()
      ->mutable_location_type()
      ->set_zone("33N");
  EXPECT_TRUE(reader.take(registration.SerializeAsString()).empty());
  auto message = detection();
  const UtmPoint grid = utm_from_geodetic({radians(49.2), radians(16.6), 0.0});
  place_in(message).set_x(grid.position.easting_m);
  place_in(message).set_y(grid.position.northing_m);
  place_in(message).set_coordinate_system(sapient::LOCATION_COORDINATE_SYSTEM_UTM_M);
  const Report found = report_of(reader.take(message.SerializeAsString()).at(0));
  EXPECT_NEAR(found.longitude_deg, 16.6, 1e-9);
  place_in(message).set_utm_zone("34N");
  const Report next = report_of(reader.take(message.SerializeAsString()).at(0));
  EXPECT_NEAR(next.longitude_deg, 22.6, 1e-9);
}

TEST(SapientReader, WhereATargetWasLostIsNoCue) {
  auto message = detection();
  message.mutable_detection_report()->set_state("lostInView");
  SapientReader reader(kGeoid);
  EXPECT_TRUE(reader.take(message.SerializeAsString()).empty());
}

TEST(SapientReader, SpeedsAreInTheUnitsOfTheRegistration) {
  SapientReader reader(kGeoid);
  auto registration = message_of_node();
  registration.mutable_registration()
      ->add_mode_definition()
      ->add_detection_definition()
      ->mutable_velocity_type()
      ->mutable_enu_velocity_units()
      ->set_east_north_rate_units(sapient::SPEED_UNITS_KPH);
  EXPECT_TRUE(reader.take(registration.SerializeAsString()).empty());
  auto message = detection();
  message.mutable_detection_report()->mutable_enu_velocity()->set_east_rate(36.0);
  const Report found = report_of(reader.take(message.SerializeAsString()).at(0));
  EXPECT_NEAR((*found.velocity_enu_m_s)[0], 10.0, 1e-12);
}

// A mode may describe several detections, and only the first of them the units.
TEST(SapientReader, ADefinitionWithoutUnitsKeepsThoseOfTheFirst) {
  SapientReader reader(kGeoid);
  auto registration = message_of_node();
  auto& mode = *registration.mutable_registration()->add_mode_definition();
  mode.add_detection_definition()
      ->mutable_velocity_type()
      ->mutable_enu_velocity_units()
      ->set_east_north_rate_units(sapient::SPEED_UNITS_KPH);
  mode.add_detection_definition()->mutable_location_type()->set_zone("33N");
  reader.take(registration.SerializeAsString());
  auto message = detection();
  message.mutable_detection_report()->mutable_enu_velocity()->set_east_rate(36.0);
  const Report found = report_of(reader.take(message.SerializeAsString()).at(0));
  EXPECT_NEAR((*found.velocity_enu_m_s)[0], 10.0, 1e-12);
}

TEST(SapientReader, NewcomersPushNobodyOut) {
  SapientReader reader(kGeoid);
  reader.take(node_status().SerializeAsString());
  for (int i = 0; i < 2000; ++i) {
    auto newcomer = node_status();
    newcomer.set_node_id("newcomer " + std::to_string(i));
    reader.take(newcomer.SerializeAsString());
  }
  EXPECT_EQ(refusal(reader.take(sight().SerializeAsString()).at(0)), Refusal::kCount);
  auto last = sight();
  last.set_node_id("newcomer 1999");
  EXPECT_EQ(refusal(reader.take(last.SerializeAsString()).at(0)), Refusal::kOtherType)
      << "no room to keep where it is";
}

TEST(SapientReader, WhatIsNoUseIsNamed) {
  SapientReader reader(kGeoid);
  EXPECT_EQ(refusal(reader.take("\xff\xff").at(0)), Refusal::kMalformed);
  EXPECT_TRUE(reader.take("").empty());
  auto message = detection();
  message.clear_timestamp();
  EXPECT_EQ(refusal(read(message)), Refusal::kMalformed);
  message = detection();
  message.set_node_id(std::string(65, 'x'));
  EXPECT_EQ(refusal(read(message)), Refusal::kMalformed);
  message = detection();
  message.mutable_detection_report()->clear_object_id();
  EXPECT_EQ(refusal(read(message)), Refusal::kMalformed);
  message = detection();
  message.mutable_detection_report()->clear_location();
  EXPECT_EQ(refusal(read(message)), Refusal::kMalformed);
  message = detection();
  place_in(message).set_y(NAN);
  EXPECT_EQ(refusal(read(message)), Refusal::kNotFinite);
  message = detection();
  place_in(message).set_y(91.0);
  EXPECT_EQ(refusal(read(message)), Refusal::kOutOfRange);
}

// Our stations do not follow themselves.
TEST(SapientReader, WhatOlsExportHasSentIsRefused) {
  const std::string bytes = exports::sapient_detection({}, exports::made_target(), kTime_us);
  SapientReader reader(kGeoid);
  EXPECT_EQ(refusal(reader.take(bytes.substr(exports::kFrameHead_bytes)).at(0)), Refusal::kOwn);
}

}  // namespace
}  // namespace ols::cues
