#include "edge/messages/messages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "conditions/alarms.h"
#include "geometry/angles.h"

namespace ols::station {
namespace {

using Status = ols_msg::station_status_t;

Sender sender() {
  Sender sender;
  sender.station = "alfa";
  sender.boot_id = 5;
  sender.utc_minus_monotonic_us = 1'700'000'000'000'000;
  sender.clock.state = clock::ClockState::kUnsynchronised;
  sender.clock.error_s = 2.0;
  return sender;
}

StationReport report() {
  StationReport report;
  report.snapshot.pose.position = {radians(49.2), radians(16.6), 250.0};
  report.snapshot.pose.position_sd_enu_m = {1.0, 2.0, 3.0};
  report.snapshot.pose.position_source = sensors::PoseSource::kSensor;
  report.snapshot.camera_ecef = {1e6, 2e6, 3e6};
  report.snapshot.counters["bearings"] = 7.0;
  device::DeviceReport gnss;
  gnss.name = "gnss";
  gnss.state = device::DeviceState::kFault;
  gnss.text = "no fix";
  gnss.last_good_s = 40.0;
  gnss.alarms = {alarm::gnss_fails("no fix")};
  gnss.readings["gnss_satellites"] = 3.0;
  gnss.counters["gnss_reports"] = 11;
  report.devices = {gnss};
  report.alarms = {{"clock: stepped"}, alarm::gnss_fails("no fix")};
  report.readings["disk_free_bytes"] = 1e9;
  report.counters["clock_steps"] = 1.0;
  report.last_error = "gnss: no fix";
  report.last_error_utime_us = 123;
  return report;
}

double value(const std::vector<std::string>& names, const std::vector<double>& values,
             const std::string& name) {
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) return std::numeric_limits<double>::quiet_NaN();
  return values[static_cast<std::size_t>(found - names.begin())];
}

TEST(StationMessages, OneStatusTellsAll) {
  const Status status = to_message(report(), sender(), StationSettings{}, 50.0, 3);
  EXPECT_EQ(status.utime, 1'700'000'050'000'000);
  EXPECT_EQ(status.position_source, +Status::POSE_SENSOR);
  EXPECT_NEAR(status.latitude_deg, 49.2, 1e-12);
  EXPECT_EQ(status.position_sd_m[2], 3.0);
  EXPECT_EQ(status.camera_ecef_m[1], 2e6);
  ASSERT_EQ(status.devices, 1);
  EXPECT_EQ(status.device_name[0], "gnss");
  EXPECT_EQ(status.device_state[0], +Status::DEVICE_FAULT);
  EXPECT_EQ(status.device_text[0], "no fix");
  EXPECT_EQ(status.device_age_s[0], 10.0);
  EXPECT_EQ(status.alarm, (std::vector<std::string>{"clock: stepped", "gnss: no fix"}));
  EXPECT_EQ(value(status.reading_name, status.reading_value, "gnss_satellites"), 3.0);
  EXPECT_EQ(value(status.reading_name, status.reading_value, "disk_free_bytes"), 1e9);
  EXPECT_EQ(value(status.counter_name, status.counter_value, "bearings"), 7.0);
  EXPECT_EQ(value(status.counter_name, status.counter_value, "gnss_reports"), 11.0);
  EXPECT_EQ(value(status.counter_name, status.counter_value, "clock_steps"), 1.0);
  EXPECT_EQ(status.clock_error_s, 2.0);
  EXPECT_EQ(status.last_error, "gnss: no fix");
  EXPECT_EQ(status.last_error_utime, 123);
  // What the arrays say of their lengths is what is sent.
  std::vector<unsigned char> bytes(static_cast<std::size_t>(status.getEncodedSize()));
  ASSERT_GT(status.encode(bytes.data(), 0, static_cast<int>(bytes.size())), 0);
  Status again;
  ASSERT_EQ(again.decode(bytes.data(), 0, static_cast<int>(bytes.size())),
            static_cast<int>(bytes.size()));
  EXPECT_EQ(again.alarm, status.alarm);
  EXPECT_EQ(again.alarm_id, (std::vector<std::string>{"", "gnss_fails"}));
  EXPECT_EQ(again.alarm_parameter_value, std::vector<std::string>{"no fix"});
}

TEST(StationMessages, APositionThatIsNotKnownIsNotTold) {
  StationReport unknown = report();
  unknown.snapshot.pose.position_source = sensors::PoseSource::kNone;
  const Status status = to_message(unknown, sender(), StationSettings{}, 50.0, 3);
  EXPECT_EQ(status.position_source, +Status::POSE_NONE);
  EXPECT_TRUE(std::isnan(status.latitude_deg));
  EXPECT_TRUE(std::isnan(status.position_sd_m[0]));
  EXPECT_TRUE(std::isnan(status.camera_ecef_m[0]));
}

TEST(StationMessages, TheClocksQualityIsInEveryBearing) {
  Bearing made;
  EXPECT_EQ(to_message(made, sender(), StationSettings{}, 1).clock_error_s, 2.0);
  made.stamp_sd_s = 1.5;
  const auto bearing = to_message(made, sender(), StationSettings{}, 1);
  EXPECT_EQ(bearing.clock_state, +ols_msg::bearing_t::CLOCK_UNSYNCHRONISED);
  EXPECT_EQ(bearing.clock_error_s, 2.5) << "the error of the frame's stamp is in it";
}

TEST(StationMessages, ABearingStatesItsAim) {
  Bearing bearing;
  bearing.sight.aim_sd_rad = 7e-5;
  EXPECT_EQ(to_message(bearing, sender(), StationSettings{}, 1).aim_sd_rad, 7e-5);
}

TEST(StationMessages, AnotherPoseIsAnotherCalibration) {
  StationSettings settings;
  settings.calibration_id = 42;
  Bearing bearing;
  EXPECT_EQ(to_message(bearing, sender(), settings, 1).calibration_id, 42);
  bearing.pose_revision = 1;
  const auto first = to_message(bearing, sender(), settings, 1).calibration_id;
  bearing.pose_revision = 2;
  const auto second = to_message(bearing, sender(), settings, 1).calibration_id;
  Sender restarted = sender();
  restarted.boot_id = 6;
  const auto third = to_message(bearing, restarted, settings, 1).calibration_id;
  EXPECT_NE(first, 42);
  EXPECT_NE(second, first);
  EXPECT_NE(third, second) << "the sensors' pose of another boot is another one";
  EXPECT_GE(std::min({first, second, third}), 0);
}

TEST(StationMessages, ABearingOfADetectedObjectSaysSo) {
  const StationSettings settings;
  Bearing bearing;
  EXPECT_FALSE(to_message(bearing, sender(), settings, 1).detected);
  bearing.detected = DetectedObject{.image_bearings = 3,
                                    .rate_rad_s = {0.1, -0.2},
                                    .rate_covariance = Eigen::Vector2d(4.0, 9.0).asDiagonal(),
                                    .size_rad = 0.003,
                                    .size_sd_rad = 0.001,
                                    .across_rad = 0.002,
                                    .size_noise_rad = 0.0004,
                                    .signal = 12.0};
  const auto message = to_message(bearing, sender(), settings, 1);
  EXPECT_TRUE(message.detected);
  EXPECT_EQ(message.image_bearings, 3);
  EXPECT_EQ(message.rate_rad_s[1], -0.2);
  EXPECT_EQ(message.rate_covariance_rad2_s2[0], 4.0);
  EXPECT_EQ(message.rate_covariance_rad2_s2[1], 0.0);
  EXPECT_EQ(message.rate_covariance_rad2_s2[2], 9.0);
  EXPECT_EQ(message.size_rad, 0.003);
  EXPECT_EQ(message.size_sd_rad, 0.001);
  EXPECT_EQ(message.across_rad, 0.002);
  EXPECT_EQ(message.size_noise_rad, 0.0004);
  EXPECT_EQ(message.signal, 12.0);
  bearing.detected->is_tracklet = false;
  EXPECT_FALSE(to_message(bearing, sender(), settings, 1).detected) << "of the followed target";
  EXPECT_FALSE(to_message(bearing, sender(), settings, 1).acquired);
  bearing.acquired = true;
  EXPECT_TRUE(to_message(bearing, sender(), settings, 1).acquired);
}

TEST(StationMessages, OnlySpansOfTimeAreRecorded) {
  ols_msg::record_t message;
  message.event_utime = 0;
  message.before_s = 2.0;
  message.after_s = 3.0;
  message.label = "flash";
  const auto command = from_message(message, sender(), 50.0);
  ASSERT_TRUE(command);
  EXPECT_EQ(command->event_s, 50.0);
  EXPECT_EQ(command->before_s, 2.0);
  EXPECT_EQ(command->label, "flash");
  message.event_utime = 1'700'000'045'000'000;
  EXPECT_NEAR(from_message(message, sender(), 50.0)->event_s, 45.0, 1e-6);
  const double inf = std::numeric_limits<double>::infinity();
  for (const double bad : {std::nan(""), inf, -inf, -1.0, 1e9}) {
    auto spoilt = message;
    spoilt.before_s = bad;
    EXPECT_FALSE(from_message(spoilt, sender(), 50.0)) << bad;
    spoilt = message;
    spoilt.after_s = bad;
    EXPECT_FALSE(from_message(spoilt, sender(), 50.0)) << bad;
  }
  for (const std::int64_t bad : {std::numeric_limits<std::int64_t>::min(), std::int64_t{1},
                                 std::numeric_limits<std::int64_t>::max()}) {
    message.event_utime = bad;
    EXPECT_FALSE(from_message(message, sender(), 50.0)) << bad;
  }
}

TEST(StationReport, OneLineSaysWhatIsWrong) {
  EXPECT_EQ(in_one_line(report()), "idle; gnss fault; clock: stepped and 1 more alarms");
  EXPECT_EQ(in_one_line(StationReport{}), "idle");
}

TEST(StationMessages, APartOfTheSkylineIsTold) {
  skyline::SkylinePart part{9, {1e6, 2e6, 3e6}, true, 71, {}};
  part.columns = {{7100, {0.125, 0.25, 100.0, true}}, {7199, {-0.5, 0.5, 0.0, false}}};
  const ols_msg::skyline_t message = to_message(part, sender(), 50.0, 3);
  EXPECT_EQ(message.utime, 1'700'000'050'000'000);
  EXPECT_EQ(message.station, "alfa");
  EXPECT_EQ(message.sequence, 3);
  EXPECT_EQ(message.begun_utime, 9);
  EXPECT_EQ(message.camera_ecef_m[1], 2e6);
  EXPECT_TRUE(message.heading_disagrees);
  EXPECT_EQ(message.sector, 71);
  EXPECT_EQ(message.columns, 2);
  EXPECT_EQ(message.column, (std::vector<std::int16_t>{7100, 7199}));
  EXPECT_EQ(message.elevation_rad, (std::vector<float>{0.125F, -0.5F}));
  EXPECT_EQ(message.sd_rad, (std::vector<float>{0.25F, 0.5F}));
  EXPECT_EQ(message.hides_from_m, (std::vector<float>{100.0F, 0.0F}));
  EXPECT_EQ(message.disagrees, (std::vector<std::int8_t>{1, 0}));
}

}  // namespace
}  // namespace ols::station
