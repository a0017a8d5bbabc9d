#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "central/app/messages.h"
#include "central/fusion/fusion.h"
#include "geometry/angles.h"
#include "geometry/wgs84.h"
#include "ols_msg/bearing_t.hpp"
#include "ols_msg/station_status_t.hpp"
#include "tests/unit/on_the_bus.h"

namespace ols::fusion {
namespace {

using Bytes = std::vector<std::uint8_t>;

ols_msg::bearing_t bearing() {
  auto message = made<ols_msg::bearing_t>();
  message.utime = 1'700'000'000'123'456;
  message.station = "north";
  message.boot_id = 77;
  message.track_id = 3;
  message.calibration_id = 12;
  message.clock_state = ols_msg::bearing_t::CLOCK_UNSYNCHRONISED;
  message.belief = 0.75;
  const Eigen::Vector3d camera = ecef_from_geodetic({0.85, 0.29, 260.0});
  for (int i = 0; i < 3; ++i) message.camera_ecef_m[i] = camera(i);
  message.azimuth_rad = 1.25;
  message.elevation_rad = 0.5;
  message.covariance_white_rad2[0] = 4e-8;
  message.covariance_white_rad2[1] = 1e-8;
  message.covariance_white_rad2[2] = 2e-8;
  message.covariance_systematic_rad2[0] = 2e-8;
  message.covariance_systematic_rad2[2] = 3e-8;
  message.aim_sd_rad = 1e-4;
  message.camera_position_sd_m[1] = 0.5;
  message.clock_error_s = 1e-3;
  return message;
}

ols_msg::station_status_t status() {
  auto message = made<ols_msg::station_status_t>();
  message.station = "north";
  const Eigen::Vector3d camera = ecef_from_geodetic({radians(49.2), radians(16.6), 251.6});
  Eigen::Vector3d::Map(message.camera_ecef_m) = camera;
  for (const int axis : {0, 1, 2}) message.position_sd_m[axis] = 0.5 + axis;
  message.counters = 2;
  message.counter_name = {"frames_captured", "frames_lost"};
  message.counter_value = {10.0, 1.0};
  message.position_source = ols_msg::station_status_t::POSE_SURVEYED;
  return message;
}

template <class Result>
bool refused(const Result& result, MessageRefusal why) {
  const auto* refusal = std::get_if<MessageRefusal>(&result);
  return refusal != nullptr && *refusal == why;
}

auto decode_bearing(const Bytes& bytes, const std::string& channel = "OLS_BEARING_north") {
  return measurement_from(channel, bytes.data(), static_cast<int>(bytes.size()));
}

auto decode_status(const Bytes& bytes, const std::string& channel = "OLS_STATUS_north") {
  return station_place_from(channel, bytes.data(), static_cast<int>(bytes.size()));
}

std::optional<MessageRefusal> no_place(const Bytes& bytes) {
  const auto result = decode_status(bytes);
  const auto* place = std::get_if<StationPlace>(&result);
  return place == nullptr ? std::nullopt : place->no_place;
}

TEST(Messages, BearingBecomesAMeasurement) {
  const auto result = decode_bearing(encoded(bearing()));
  ASSERT_TRUE(std::holds_alternative<BearingMeasurement>(result));
  const auto& measurement = std::get<BearingMeasurement>(result);
  EXPECT_EQ(measurement.station, "north");
  EXPECT_EQ(measurement.utime_us, 1'700'000'000'123'456);
  EXPECT_EQ(measurement.boot_id, 77);
  EXPECT_EQ(measurement.track_id, 3);
  EXPECT_EQ(measurement.belief, 0.75);
  EXPECT_EQ(measurement.clock_sd_s, 1e-3);
  EXPECT_EQ(measurement.clock, StationClock::kUnsynchronised);
  EXPECT_EQ(measurement.calibration_id, 12);
  EXPECT_EQ(measurement.sight.direction.azimuth_rad, 1.25);
  EXPECT_EQ(measurement.sight.direction.elevation_rad, 0.5);
  EXPECT_EQ(measurement.sight.covariance_white(0, 0), 4e-8);
  EXPECT_EQ(measurement.sight.covariance_white(1, 0), 1e-8);
  EXPECT_EQ(measurement.sight.covariance_white(1, 1), 2e-8);
  EXPECT_EQ(measurement.sight.covariance_systematic(1, 1), 3e-8);
  EXPECT_EQ(measurement.sight.aim_sd_rad, 1e-4);
  EXPECT_EQ(measurement.sight.origin_sd_enu_m, Eigen::Vector3d(0, 0.5, 0));
  EXPECT_EQ(check(measurement), BearingRefusal::kNone);
}

TEST(Messages, AStatusNamesItsMountIfItsSerialNumberIsOne) {
  for (const auto& [text, mount] : std::vector<std::array<std::string, 2>>{
           {"ONVIF A B, serial 17: moves absolute, clock +0 s", "ONVIF A B, serial 17"},
           {"ONVIF A B, serial 0000: moves absolute", ""},
           {"ONVIF A B: moves absolute", ""},
           {"no connection: timed out", ""}}) {
    auto message = status();
    message.devices = 2;
    message.device_name = {"camera", "ptu"};
    message.device_state = {2, 2};
    message.device_text = {"another, serial 18: x", text};
    message.device_age_s = {0.0, 0.0};
    const auto result = decode_status(encoded(message));
    EXPECT_EQ(std::get<StationPlace>(result).traits.mount, mount) << text;
    EXPECT_EQ(std::get<StationPlace>(result).traits.stated_us, message.utime);
  }
}

TEST(Messages, ABearingSaysWhatADetectorSaw) {
  auto message = bearing();
  message.detected = 1;
  message.image_bearings = 3;
  message.rate_rad_s[0] = 0.01;
  message.rate_rad_s[1] = -0.02;
  message.rate_covariance_rad2_s2[0] = message.rate_covariance_rad2_s2[2] = 1e-6;
  message.rate_covariance_rad2_s2[1] = 2e-7;
  message.size_rad = 2e-3;
  message.size_sd_rad = 3e-4;
  message.across_rad = 1e-3;
  message.size_noise_rad = 1e-4;
  message.acquired = 1;
  message.signal = 9.5;
  message.classes = 2;
  message.class_probability = {0.25, 0.75};
  const auto measurement = std::get<BearingMeasurement>(decode_bearing(encoded(message)));
  EXPECT_TRUE(measurement.is_tracklet);
  EXPECT_EQ(measurement.image_bearings, 3);
  EXPECT_TRUE(measurement.sighted.has_rate());
  EXPECT_EQ(measurement.sighted.rate_rad_s, Eigen::Vector2d(0.01, -0.02));
  EXPECT_EQ(measurement.sighted.rate_covariance(1, 0), 2e-7);
  EXPECT_EQ(measurement.sighted.size_rad, 2e-3);
  EXPECT_EQ(measurement.sighted.size_sd_rad, 3e-4);
  EXPECT_EQ(measurement.sighted.across_rad, 1e-3);
  EXPECT_EQ(measurement.sighted.size_noise_rad, 1e-4);
  EXPECT_TRUE(measurement.is_acquired);
  EXPECT_EQ(measurement.sighted.signal, 9.5);
  EXPECT_EQ(measurement.sighted.class_probability, (std::vector{0.25, 0.75}));
}

// As a log of before has it (lcmtypes/README.md).
TEST(Messages, ABearingOfBeforeDetectorsIsOfADesignatedObject) {
  ols_msg::bearing_v1_t former{};
  former.schema_version = ols_msg::bearing_t::SCHEMA_VERSION;
  former.station = "north";
  former.track_id = 3;
  former.clock_error_s = 1e-3;
  const auto result = decode_bearing(encoded(former));
  const auto* const measurement = std::get_if<BearingMeasurement>(&result);
  ASSERT_NE(measurement, nullptr);
  EXPECT_EQ(measurement->track_id, 3);
  EXPECT_EQ(measurement->clock_sd_s, 1e-3);
  EXPECT_FALSE(measurement->is_tracklet);
  EXPECT_FALSE(measurement->is_acquired);
  EXPECT_EQ(measurement->image_bearings, 0);
  EXPECT_FALSE(measurement->sighted.has_rate());
  EXPECT_TRUE(measurement->sighted.class_probability.empty());
}

TEST(Messages, StatusTellsWhereAStationStands) {
  const auto result = decode_status(encoded(status()));
  ASSERT_TRUE(std::holds_alternative<StationPlace>(result));
  const auto& place = std::get<StationPlace>(result);
  EXPECT_EQ(place.station, "north");
  const Eigen::Vector3d there = ecef_from_geodetic({radians(49.2), radians(16.6), 251.6});
  EXPECT_EQ(place.traits.camera_ecef, there);
  EXPECT_EQ(place.traits.camera_sd_enu_m, Eigen::Vector3d(0.5, 1.5, 2.5));
  EXPECT_TRUE(place.traits.commandable);
  EXPECT_FALSE(place.no_place);
}

TEST(Messages, NoStationIsWhereNoneCanBe) {
  const double nan = std::nan("");
  for (const double wrong : {nan, 1e9, -1e300}) {
    auto message = status();
    message.camera_ecef_m[1] = wrong;
    EXPECT_EQ(no_place(encoded(message)), MessageRefusal::kOutOfRange) << wrong;
  }
  for (const double wrong : {nan, -1.0, 1e9}) {
    auto message = status();
    message.position_sd_m[2] = wrong;
    EXPECT_EQ(no_place(encoded(message)), MessageRefusal::kOutOfRange) << wrong;
  }
}

TEST(Messages, WhomTheOperatorHasTheFusionLeavesAlone) {
  using M = ols_msg::station_status_t;
  for (const std::int8_t state : {M::STATE_MANUAL, M::STATE_STOPPED, M::STATE_EMERGENCY}) {
    auto message = status();
    message.state = state;
    const auto result = decode_status(encoded(message));
    EXPECT_FALSE(std::get<StationPlace>(result).traits.commandable) << int{state};
  }
  for (const std::int8_t kind : {M::KIND_OVERVIEW, M::KIND_FIXED}) {
    auto message = status();
    message.kind = kind;
    const auto result = decode_status(encoded(message));
    EXPECT_FALSE(std::get<StationPlace>(result).traits.commandable) << int{kind};
  }
}

TEST(Messages, StatusTellsLatencyAndFieldOfView) {
  auto message = status();
  message.frame_latency_s = 0.12;
  message.field_of_view_rad[0] = 0.3;
  message.field_of_view_rad[1] = 0.2;
  const auto known = std::get<StationPlace>(decode_status(encoded(message))).traits;
  EXPECT_EQ(known.latency_s, 0.12);
  EXPECT_EQ(known.field_of_view_rad, 0.2);
  message.frame_latency_s = std::nan("");
  message.field_of_view_rad[1] = -1.0;
  const auto fallback = std::get<StationPlace>(decode_status(encoded(message))).traits;
  EXPECT_EQ(fallback.latency_s, StationTraits{}.latency_s);
  EXPECT_EQ(fallback.field_of_view_rad, StationTraits{}.field_of_view_rad);
}

TEST(Messages, OneStationAloneGivesItsLine) {
  FusedTarget target;
  target.estimator = "filter";
  target.estimate.solution = Solution::kBearingOnly;
  BearingOnly only{.station = "a", .track_id = 2, .sight = {}, .rate_rad_s = {0.1, 0.2}};
  only.sight.direction = {1.0, 0.5};
  only.sight.covariance_white = Eigen::Matrix2d::Identity() * 9e-8;
  target.bearing_only = only;
  const auto message = to_message(target, MessageStamp{});
  EXPECT_EQ(message.solution, std::int8_t{ols_msg::target_t::SOLUTION_BEARING_ONLY});
  EXPECT_EQ(message.azimuth_rad, 1.0);
  EXPECT_NEAR(message.direction_sd_rad, 3e-4, 1e-12);
  EXPECT_EQ(message.direction_rate_rad_s[1], 0.2);
  EXPECT_TRUE(std::isnan(message.latitude_deg));
}

TEST(Messages, EveryTruncationIsRefused) {
  const Bytes whole_bearing = encoded(bearing());
  for (std::size_t size = 0; size < whole_bearing.size(); ++size) {
    const Bytes part(whole_bearing.begin(), whole_bearing.begin() + static_cast<long>(size));
    EXPECT_TRUE(refused(decode_bearing(part), MessageRefusal::kMalformed)) << size;
  }
  const Bytes whole_status = encoded(status());
  for (std::size_t size = 0; size < whole_status.size(); ++size) {
    const Bytes part(whole_status.begin(), whole_status.begin() + static_cast<long>(size));
    EXPECT_TRUE(refused(decode_status(part), MessageRefusal::kMalformed)) << size;
  }
}

TEST(Messages, ForeignAndLongerMessagesAreRefused) {
  EXPECT_TRUE(refused(decode_bearing(encoded(status())), MessageRefusal::kMalformed));
  EXPECT_TRUE(refused(decode_status(encoded(bearing())), MessageRefusal::kMalformed));
  Bytes longer = encoded(bearing());
  longer.push_back(0);
  EXPECT_TRUE(refused(decode_bearing(longer), MessageRefusal::kMalformed));
}

// The string's length follows stamp and version: 8 + 8 + 4 bytes.
TEST(Messages, AbsurdLengthsAreRefused) {
  for (const std::uint32_t length : {0U, 0xFFFFFFFFU, 0x80000000U, 0x7FFFFFFFU}) {
    Bytes bytes = encoded(bearing());
    for (int i = 0; i < 4; ++i) {
      bytes[static_cast<std::size_t>(20 + i)] = static_cast<std::uint8_t>(length >> (24 - 8 * i));
    }
    EXPECT_TRUE(refused(decode_bearing(bytes), MessageRefusal::kMalformed)) << length;
  }
}

TEST(Messages, AnyDamageIsSurvived) {
  constexpr unsigned kSeed = 11;
  std::mt19937 random(kSeed);
  const Bytes whole = encoded(bearing());
  int decoded = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    Bytes bytes = whole;
    for (int flips = 0; flips < 3; ++flips) {
      bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    }
    const auto result = decode_bearing(bytes);
    if (const auto* measurement = std::get_if<BearingMeasurement>(&result)) {
      Fusion fusion{FusionConfig{}};
      fusion.add(*measurement);
      ++decoded;
    }
  }
  EXPECT_GT(decoded, 1000) << "seed " << kSeed;
}

TEST(Messages, OtherSchemaStationOrPlaceIsRefused) {
  auto other = bearing();
  other.schema_version = 99;
  EXPECT_TRUE(refused(decode_bearing(encoded(other)), MessageRefusal::kSchema));
  EXPECT_TRUE(refused(decode_bearing(encoded(bearing()), "OLS_BEARING_south"),
                      MessageRefusal::kOtherStation));
  other = bearing();
  other.station = "";
  EXPECT_TRUE(
      refused(decode_bearing(encoded(other), "OLS_BEARING_"), MessageRefusal::kOtherStation));
  auto nowhere = status();
  nowhere.camera_ecef_m[0] = std::nan("");
  EXPECT_EQ(no_place(encoded(nowhere)), MessageRefusal::kOutOfRange);
  nowhere.position_source = ols_msg::station_status_t::POSE_NONE;
  EXPECT_EQ(no_place(encoded(nowhere)), MessageRefusal::kNoPosition);
}

// Operator control of a station counts, whether the station knows its position or not.
TEST(Messages, AStatusWithoutAPlaceTellsWhoHasTheStation) {
  auto nowhere = status();
  nowhere.position_source = ols_msg::station_status_t::POSE_NONE;
  nowhere.state = ols_msg::station_status_t::STATE_MANUAL;
  const auto result = decode_status(encoded(nowhere));
  ASSERT_TRUE(std::holds_alternative<StationPlace>(result));
  EXPECT_EQ(std::get<StationPlace>(result).station, "north");
  EXPECT_FALSE(std::get<StationPlace>(result).traits.commandable);
}

TEST(Messages, TargetCarriesGeodeticPositionAndEnuCovariance) {
  FusedTarget target;
  target.utime_us = 5;
  target.target_id = 1;
  target.estimator = "least-squares";
  target.stations = {{"a", true, 1.0, 0.01}, {"b", false, 0.0, -0.01}};
  const Geodetic place{radians(49.2), radians(16.6), 300.0};
  const Eigen::Matrix3d R = R_ecef_enu(place);
  Eigen::Matrix3d enu;
  enu << 1.0, 0.1, 0.2, 0.1, 4.0, 0.3, 0.2, 0.3, 9.0;
  target.estimate.solution = Solution::kOk;
  target.estimate.position_ecef = ecef_from_geodetic(place);
  target.estimate.covariance_ecef = R * enu * R.transpose();
  target.estimate.covariance_white_ecef = target.estimate.covariance_ecef / 2.0;
  target.above_ground = HeightAboveGround{-0.5, 1.5};
  const auto message = to_message(target, MessageStamp{7, 8});
  EXPECT_EQ(message.boot_id, 7);
  EXPECT_EQ(message.sequence, 8);
  EXPECT_NEAR(message.latitude_deg, 49.2, 1e-12);
  EXPECT_NEAR(message.height_m, 300.0, 1e-8);
  const double expected[6] = {1.0, 0.1, 0.2, 4.0, 0.3, 9.0};
  for (int i = 0; i < 6; ++i) {
    EXPECT_NEAR(message.position_covariance_enu_m2[i], expected[i], 1e-9);
    EXPECT_NEAR(message.position_covariance_white_enu_m2[i], expected[i] / 2.0, 1e-9);
    EXPECT_TRUE(std::isnan(message.velocity_covariance_enu_m2_s2[i]));
  }
  EXPECT_TRUE(message.has_height_above_ground);
  EXPECT_EQ(message.height_above_ground_m, -0.5);
  EXPECT_EQ(message.height_above_ground_sd_m, 1.5);
  ASSERT_EQ(message.stations, 2);
  EXPECT_TRUE(message.used[0]);
  EXPECT_FALSE(message.used[1]);
  EXPECT_EQ(encoded(message).size(), static_cast<std::size_t>(message.getEncodedSize()));

  target.estimate = Estimate();
  target.estimate.solution = Solution::kParallelRays;
  const auto without = to_message(target, MessageStamp{});
  EXPECT_EQ(without.solution, std::int8_t{ols_msg::target_t::SOLUTION_PARALLEL_RAYS});
  EXPECT_TRUE(std::isnan(without.latitude_deg));
  EXPECT_TRUE(std::isnan(without.position_ecef_m[0]));
}

TEST(Messages, SolutionsHaveTheNumbersOfTheMessage) {
  using M = ols_msg::target_t;
  EXPECT_EQ(static_cast<int>(Solution::kOk), int{M::SOLUTION_OK});
  EXPECT_EQ(static_cast<int>(Solution::kTooFewRays), int{M::SOLUTION_TOO_FEW_RAYS});
  EXPECT_EQ(static_cast<int>(Solution::kParallelRays), int{M::SOLUTION_PARALLEL_RAYS});
  EXPECT_EQ(static_cast<int>(Solution::kBehindCamera), int{M::SOLUTION_BEHIND_CAMERA});
  EXPECT_EQ(static_cast<int>(Solution::kTooFar), int{M::SOLUTION_TOO_FAR});
  EXPECT_EQ(static_cast<int>(Solution::kNotConverged), int{M::SOLUTION_NOT_CONVERGED});
  EXPECT_EQ(static_cast<int>(Solution::kBearingOnly), int{M::SOLUTION_BEARING_ONLY});
  EXPECT_EQ(static_cast<int>(Solution::kRaysMiss), int{M::SOLUTION_RAYS_MISS});
  EXPECT_EQ(static_cast<int>(Solution::kAmbiguous), int{M::SOLUTION_AMBIGUOUS});
}

}  // namespace
}  // namespace ols::fusion
