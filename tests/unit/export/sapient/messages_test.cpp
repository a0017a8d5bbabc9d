#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <regex>

#include "export/sapient/frame.h"
#include "export/sapient/identifiers.h"
#include "export/sapient/registration.h"
#include "export/sapient/sapient_messages.h"
#include "export/sapient/sapient_node.h"
#include "export/sapient/scan.h"
#include "geometry/angles.h"
#include "geometry/wgs84.h"
#include "tests/unit/export/made_records.h"
#include "tests/unit/export/sapient/said.h"

namespace ols::exports {
namespace {

TEST(Frame, TheLengthComesFirstLeastSignificantByteBefore) {
  const std::string bytes = framed(std::string(0x0102, 'x'));
  EXPECT_EQ(bytes.substr(0, 5), std::string("\x02\x01\x00\x00x", 5));
  EXPECT_EQ(framed_length(bytes), 0x0102U);
  EXPECT_EQ(framed_length(bytes.substr(0, 3)), std::nullopt);
  EXPECT_EQ(framed_length("\xff\xff\xff\xff"), 0xffff'ffffU);
}

TEST(Identifiers, AUuidIsOfVersion4AndOfItsName) {
  const std::regex form("[0-9a-f]{8}-[0-9a-f]{4}-4[0-9a-f]{3}-[89ab][0-9a-f]{3}-[0-9a-f]{12}");
  for (const char* name : {"", "brno.fusion", "x"}) {
    EXPECT_TRUE(std::regex_match(uuid_of(name), form)) << uuid_of(name);
    EXPECT_TRUE(is_uuid(uuid_of(name)));
  }
  EXPECT_NE(uuid_of("a"), uuid_of("b"));
  // It must never change: receivers would take the site for another one.
  EXPECT_EQ(uuid_of("brno.fusion"), "1fa38d49-b6a4-4f84-a99f-1c71c5f25d8c");
}

TEST(Identifiers, OtherTextsAreNoUuid) {
  for (const char* text :
       {"", "brno", "6F1D0C5E-9342-4A8B-B725-0E61D48F3A19", "6f1d0c5e-9342-1a8b-b725-0e61d48f3a19",
        "6f1d0c5e-9342-4a8b-c725-0e61d48f3a19", "6f1d0c5e-9342-4a8b-b725-0e61d48f3a1",
        "6f1d0c5e+9342-4a8b-b725-0e61d48f3a19"}) {
    EXPECT_FALSE(is_uuid(text)) << text;
  }
}

TEST(Identifiers, AUlidHasItsTimeAndItsName) {
  const std::regex form("[0-7][0-9A-HJKMNP-TV-Z]{25}");
  EXPECT_TRUE(std::regex_match(ulid_of(0, "a"), form));
  EXPECT_TRUE(std::regex_match(ulid_of(281'474'976'710'655, "a"), form));
  // The example of the ULID's own specification.
  EXPECT_EQ(ulid_of(1'469'918'176'385, "a").substr(0, 10), "01ARYZ6S41");
  EXPECT_EQ(ulid_of(1, "a").substr(10), ulid_of(2, "a").substr(10));
  EXPECT_NE(ulid_of(1, "a"), ulid_of(1, "b"));
  EXPECT_EQ(ulid_of(0, "brno.target.000000000000004d.7"), "0000000000B9CAX047A1PHF75P");
}

TEST(Registration, SaysWhatReportsHold) {
  const auto message = said(sapient_registration({.site = "brno", .status_s = 2.5}, kNow_us));
  const auto& registration = message.registration();
  EXPECT_EQ(registration.icd_version(), "BSI Flex 335 v2.0");
  EXPECT_EQ(registration.short_name(), "OLS brno");
  EXPECT_FLOAT_EQ(registration.status_definition().status_interval().value(), 2.5F);
  ASSERT_EQ(registration.mode_definition_size(), 1);
  const auto& detections = registration.mode_definition(0).detection_definition(0);
  EXPECT_EQ(detections.location_type().location_datum(), sapient::LOCATION_DATUM_WGS84_E);
  EXPECT_EQ(detections.velocity_type().enu_velocity_units().up_rate_units(),
            sapient::SPEED_UNITS_MS);
  for (const auto& field : detections.detection_report()) {
    EXPECT_TRUE(field.type().starts_with("ols.")) << field.type();
  }
  EXPECT_EQ(detections.detection_report_size(), 4);
}

const SapientSettings kBrno{.site = "brno"};

sapient::DetectionReport detection(const Target& target, std::int64_t after_us = 0) {
  return said(sapient_detection(kBrno, target, target.utime_us + after_us)).detection_report();
}

TEST(Registration, NamesEachClassAsReportsDo) {
  const auto message = said(sapient_registration(kBrno, kNow_us));
  const auto& mode = message.registration().mode_definition(0);
  const auto& classes = mode.detection_definition(0).detection_class_definition(0);
  ASSERT_EQ(classes.class_definition_size(), static_cast<int>(wire::kObjectClasses.size()));
  for (std::size_t i = 0; i < wire::kObjectClasses.size(); ++i) {
    Target target = made_target();
    target.object_class = wire::kObjectClasses[i].object_class;
    EXPECT_EQ(classes.class_definition(static_cast<int>(i)).type(),
              detection(target).classification(0).type());
  }
}

std::string information(const sapient::DetectionReport& report, const std::string& type) {
  for (const auto& one : report.track_info()) {
    if (one.type() == type) return one.value();
  }
  return "none";
}

TEST(SapientMessages, EachSaysWhoAndWhen) {
  for (const std::string& bytes :
       {sapient_status(kBrno, {}, kNow_us), sapient_detection(kBrno, made_target(), kNow_us),
        sapient_task_refusal(kBrno, "t", "n", kNow_us)}) {
    const auto message = said(bytes);
    EXPECT_EQ(message.node_id(), node_id(kBrno));
    EXPECT_EQ(message.timestamp().seconds(), kNow_us / 1'000'000);
  }
}

// 100 m above the ellipsoid, where the geoid is 46 m above it.
TEST(SapientMessages, ATargetsHeightIsAboveTheEllipsoid) {
  const auto place = detection(made_target()).location();
  EXPECT_DOUBLE_EQ(place.y(), 47.5);
  EXPECT_DOUBLE_EQ(place.x(), 13.25);
  EXPECT_DOUBLE_EQ(place.z(), 100.0);
  EXPECT_EQ(place.datum(), sapient::LOCATION_DATUM_WGS84_E);
  EXPECT_EQ(place.coordinate_system(), sapient::LOCATION_COORDINATE_SYSTEM_LAT_LNG_DEG_M);
}

TEST(SapientMessages, DeviationsAreInTheUnitsOfThePlace) {
  const auto place = detection(made_target()).location();
  EXPECT_NEAR(place.x_error() * 111'320.0 * std::cos(radians(47.5)), 2.0, 0.01);
  EXPECT_NEAR(place.y_error() * 111'180.0, 3.0, 0.01);
  EXPECT_DOUBLE_EQ(place.z_error(), 5.0);
  const auto report = detection(made_target());
  EXPECT_EQ(information(report, "ols.covariance_enu_m2"),
            "4.0000 1.0000 0.0000 9.0000 0.0000 25.0000");
  EXPECT_EQ(information(report, "ols.stations"), "alfa bravo");
  EXPECT_DOUBLE_EQ(report.enu_velocity().north_rate(), 4.0);
  EXPECT_DOUBLE_EQ(report.enu_velocity().up_rate_error(), 1.0);
}

TEST(SapientMessages, ATargetIsWhereItIsAtTheInstantOfTheReport) {
  const Target target = made_target();  // 3 m/s east, 4 north, -1.5 up
  const auto place = detection(target, -80'000).location();
  const auto at = [](const sapient::Location& location) {
    return ecef_from_geodetic({radians(location.y()), radians(location.x()), location.z()});
  };
  const LocalFrame frame({radians(47.5), radians(13.25), 100.0});
  const Eigen::Vector3d moved = frame.to_enu(at(place));
  EXPECT_NEAR(moved.x(), -0.24, 1e-4);
  EXPECT_NEAR(moved.y(), -0.32, 1e-4);
  EXPECT_NEAR(moved.z(), 0.12, 1e-4);
}

TEST(SapientMessages, WhatIsNotKnownIsNotSaid) {
  Target target = made_target();
  target.velocity_enu_m_s.fill(kUnknown);
  target.covariance_m2.fill(kUnknown);
  const auto report = detection(target, 80'000);
  EXPECT_FALSE(report.has_enu_velocity());
  EXPECT_FALSE(report.location().has_x_error() || report.location().has_z_error());
  EXPECT_DOUBLE_EQ(report.location().y(), 47.5);
  EXPECT_EQ(information(report, "ols.covariance_enu_m2"), "none");
}

TEST(SapientMessages, AnObjectKeepsItsNameAndAReportHasItsOwn) {
  Target target = made_target();
  const auto first = detection(target);
  target.utime_us += 100'000;
  const auto second = detection(target);
  EXPECT_EQ(first.object_id(), second.object_id());
  EXPECT_NE(first.report_id(), second.report_id());
  EXPECT_FALSE(second.has_state());
  target.state = TrackState::kEnded;
  const auto last = detection(target);
  EXPECT_EQ(last.state(), "lost");
  EXPECT_NE(last.report_id(), second.report_id());
  EXPECT_NE(detection(made_target(8)).object_id(), first.object_id());
}

TEST(SapientMessages, TheNodeIsInTheMiddleOfItsStations) {
  Station east = made_station(), west = made_station();
  east.place = {47.0, -179.9, 500.0, 46.0};
  west.place = {48.0, 179.7, 700.0, 46.0};
  const auto report = said(sapient_status(kBrno, {east, west}, kNow_us)).status_report();
  EXPECT_NEAR(report.node_location().x(), 179.9, 1e-9);
  EXPECT_DOUBLE_EQ(report.node_location().y(), 47.5);
  EXPECT_DOUBLE_EQ(report.node_location().z(), 600.0);
  EXPECT_EQ(report.node_location().datum(), sapient::LOCATION_DATUM_WGS84_E);
  EXPECT_EQ(report.system(), sapient::StatusReport::SYSTEM_OK);
  EXPECT_EQ(report.status(0).status_value(), "alfa: tracking");
}

TEST(SapientMessages, WhatIsWrongIsSaid) {
  const auto none = said(sapient_status(kBrno, {}, kNow_us)).status_report();
  EXPECT_EQ(none.system(), sapient::StatusReport::SYSTEM_WARNING);
  EXPECT_EQ(none.status(0).status_type(), sapient::StatusReport::STATUS_TYPE_NOT_DETECTING);
  EXPECT_FALSE(none.has_node_location());
  Station ill = made_station();
  ill.is_well = false;
  ill.alarms = 2;
  ill.clock_is_good = false;
  const auto report = said(sapient_status(kBrno, {made_station(), ill}, kNow_us)).status_report();
  EXPECT_EQ(report.system(), sapient::StatusReport::SYSTEM_WARNING);
  EXPECT_EQ(report.status(1).status_value(), "alfa: tracking, 2 alarms, clock not synchronised");
  EXPECT_EQ(report.status(1).status_level(), sapient::StatusReport::STATUS_LEVEL_WARNING_STATUS);
}

TEST(Scan, TargetsOfNearlyOneInstantAreToldAtOne) {
  Scan scan;
  EXPECT_EQ(scan.instant_of(made_target(1)), kNow_us);
  EXPECT_EQ(scan.instant_of(made_target(2, 50'000)), kNow_us);
  EXPECT_EQ(scan.instant_of(made_target(3, -50'000)), kNow_us);
  EXPECT_EQ(scan.instant_of(made_target(1, 100'000)), kNow_us + 100'000);
}

TEST(Scan, ATargetIsToldOnceAtAnInstantUnlessItsStateChanges) {
  Scan scan;
  Target target = made_target();
  EXPECT_TRUE(scan.instant_of(target));
  target.utime_us += 60'000;
  EXPECT_EQ(scan.instant_of(target), std::nullopt);
  target.state = TrackState::kEnded;
  EXPECT_EQ(scan.instant_of(target), kNow_us);
  scan.begin_again();
  EXPECT_EQ(scan.instant_of(target), kNow_us);
}

TEST(Scan, AnInstantOfTheFutureDoesNotStayForEver) {
  Scan scan;
  EXPECT_TRUE(scan.instant_of(made_target(1, 5'000'000)));
  EXPECT_EQ(scan.instant_of(made_target(2)), kNow_us);
  Target absurd = made_target(3);
  absurd.utime_us = std::numeric_limits<std::int64_t>::min();
  EXPECT_TRUE(scan.instant_of(absurd));
  EXPECT_EQ(scan.instant_of(made_target(2)), kNow_us);
}

TEST(SapientNode, ASiteHasItsOwnNameOrTheGivenOne) {
  EXPECT_EQ(node_id({.site = "brno"}), node_id({.site = "brno"}));
  EXPECT_NE(node_id({.site = "wien"}), node_id({.site = "brno"}));
  EXPECT_EQ(node_id({.site = "brno", .node_id = "given"}), "given");
}

TEST(SapientNode, AMessageSaysWhoAndWhen) {
  const auto message = message_of({.node_id = "given"}, kNow_us);
  EXPECT_EQ(message.node_id(), "given");
  EXPECT_EQ(message.timestamp().seconds(), kNow_us / 1'000'000);
  EXPECT_EQ(message.timestamp().nanos(), 123'000'000);
}

}  // namespace
}  // namespace ols::exports
