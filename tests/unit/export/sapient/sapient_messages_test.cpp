#include "export/sapient/sapient_messages.h"

#include <cmath>

#include "geometry/angles.h"
#include "geometry/wgs84.h"
#include "tests/unit/export/made_records.h"
#include "tests/unit/export/sapient/said.h"

namespace ols::exports {
namespace {

const SapientSettings kBrno{.site = "brno"};

sapient::DetectionReport detection(const Target& target, std::int64_t after_us = 0) {
  return said(sapient_detection(kBrno, target, target.utime_us + after_us)).detection_report();
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

}  // namespace
}  // namespace ols::exports
