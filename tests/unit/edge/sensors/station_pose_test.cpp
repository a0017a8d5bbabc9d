#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>
#include <variant>

#include "base/files/fnv1a.h"
#include "edge/sensors/persisted_pose.h"
#include "edge/sensors/station_position.h"
#include "edge/sensors/station_tilt.h"
#include "geometry/angles.h"
#include "still_tripod.h"

namespace ols::sensors {
namespace {

using Eigen::Vector3d;
using test::distance_m;
using test::fix;
using test::kGround;
using test::moved;
using test::sensors_only;
using test::surveyed;
using test::tilt;
using testing::ElementsAre;
using testing::IsEmpty;

StationPose pose_of(const StationPosition& position, double now_s) {
  StationPose pose;
  position.fill(pose, now_s);
  return pose;
}

std::vector<Alarm> alarms_of(const StationPosition& position, double now_s) {
  std::vector<Alarm> alarms;
  position.add_alarms(alarms, now_s);
  return alarms;
}

TEST(StationPosition, FewerReadingsThanAgreeAreNoPosition) {
  StationPosition position(sensors_only());
  position.add(fix(0.0));
  position.add(fix(1.0));
  EXPECT_EQ(pose_of(position, 1.0).position_source, PoseSource::kNone);
  position.add(fix(2.0));
  EXPECT_EQ(pose_of(position, 2.0).position_source, PoseSource::kSensor);
}

TEST(StationPosition, NoStatedSdIsBelievedBelowTheFloor) {
  StationPosition position(sensors_only());
  for (int i = 0; i < 10; ++i) position.add(fix(i, Vector3d::Zero(), 1e-6));
  EXPECT_NEAR(pose_of(position, 10.0).position_sd_enu_m.x(), 0.01, 1e-9);
}

TEST(StationPosition, BetterFixesTakeOver) {
  StationPosition position(sensors_only());
  for (int i = 0; i < 60; ++i) position.add(fix(i, {1.5, -1.0, 2.0}, 2.0));
  EXPECT_NEAR(pose_of(position, 60.0).position_sd_enu_m.x(), 2.0, 1e-6);
  for (int i = 60; i < 120; ++i) position.add(fix(i));
  EXPECT_LT(distance_m(pose_of(position, 120.0).position, kGround), 0.02);
  EXPECT_LT(pose_of(position, 120.0).position_sd_enu_m.x(), 0.03);
}

TEST(StationPosition, ANewPlaceIsTakenOnlyWhereThatIsConfigured) {
  PoseEstimator::Config config = sensors_only();
  config.accept_move_s = 600.0;
  StationPosition position(config);
  double now_s = 0.0;
  for (; now_s < 60.0; now_s += 1.0) position.add(fix(now_s));
  for (; now_s < 600.0; now_s += 1.0) position.add(fix(now_s, {8.0, 0.0, 0.0}));
  EXPECT_LT(distance_m(pose_of(position, now_s).position, kGround), 1e-3);
  for (; now_s < 700.0; now_s += 1.0) position.add(fix(now_s, {8.0, 0.0, 0.0}));
  EXPECT_LT(distance_m(pose_of(position, now_s).position, moved(kGround, {8.0, 0.0, 0.0})), 1e-3);
  EXPECT_THAT(
      alarms_of(position, now_s),
      ElementsAre("gnss: new position adopted, 8.00 m from the old one: check the heading"));
}

TEST(StationPosition, FixesWorseThanAskedForAreNotUsed) {
  PoseEstimator::Config config = sensors_only();
  config.least_fix = GnssFix::kRtkFloat;
  StationPosition position(config);
  for (int i = 0; i < 10; ++i) {
    GnssReading r = fix(i);
    r.fix = GnssFix::kDifferential;
    position.add(r);
  }
  EXPECT_EQ(pose_of(position, 10.0).position_source, PoseSource::kNone);
  EXPECT_THAT(alarms_of(position, 10.0), ElementsAre("gnss: no fix yet, no position yet"));
}

TEST(StationPosition, ImpossibleReadingsAreNoFixes) {
  StationPosition position(sensors_only());
  GnssReading r = fix(0.0);
  for (int i = 0; i < 10; ++i) {
    r.time_s = i;
    if (i % 2 == 0) r.sd_enu_m.x() = -1.0;
    if (i % 2 == 1) r.antenna.height_m = std::numeric_limits<double>::quiet_NaN();
    position.add(r);
    r = fix(0.0);
  }
  EXPECT_EQ(pose_of(position, 10.0).position_source, PoseSource::kNone);
  EXPECT_FALSE(position.is_from_sensor());
}

StationPose pose_of(const StationTilt& tilt, double now_s) {
  StationPose pose;
  tilt.fill(pose, now_s);
  return pose;
}

std::vector<Alarm> alarms_of(const StationTilt& tilt, double now_s) {
  std::vector<Alarm> alarms;
  tilt.add_alarms(alarms, now_s);
  return alarms;
}

TEST(StationTilt, ASlowSettlingOfTheTripodIsFollowed) {
  StationTilt settling(sensors_only());
  for (int i = 0; i < 36000; ++i) settling.add(tilt(0.1 * i, 0.12 + 0.3 * i / 36000.0));
  EXPECT_NEAR(degrees(pose_of(settling, 3600.0).tilt_x_rad), 0.42, 0.01);
  EXPECT_THAT(alarms_of(settling, 3600.0), IsEmpty());
}

// A frozen sensor repeats one reading to its last digit.
TEST(StationTilt, AStuckSensorIsNotBelievedAndIsAnAlarm) {
  StationTilt stuck(sensors_only());
  for (int i = 0; i < 100; ++i) stuck.add(tilt(0.1 * i));
  const double before_sd_rad = pose_of(stuck, 10.0).tilt_sd_rad;
  for (int i = 0; i < 1200; ++i) stuck.add({10.0 + 0.1 * i, radians(0.12), radians(-0.08)});
  EXPECT_THAT(alarms_of(stuck, 130.0), ElementsAre("inclinometer: stuck for 2 min, tilt kept"));
  EXPECT_GT(pose_of(stuck, 130.0).tilt_sd_rad, before_sd_rad);
  stuck.add(tilt(131.0));
  EXPECT_THAT(alarms_of(stuck, 131.0), IsEmpty()) << "it moves again";
}

TEST(StationTilt, ReadingsThatCannotBeAreIgnored) {
  StationTilt spoilt(sensors_only());
  for (int i = 0; i < 20; ++i) spoilt.add(tilt(i));
  const double before_rad = pose_of(spoilt, 20.0).tilt_x_rad;
  spoilt.add({21.0, std::numeric_limits<double>::quiet_NaN(), 0.0});
  spoilt.add({22.0, 2.0, 0.0});  // [rad] a tripod does not stand like that
  spoilt.add({5.0, radians(0.13), 0.0});
  EXPECT_EQ(pose_of(spoilt, 20.0).tilt_x_rad, before_rad);
}

TEST(StationTilt, AResumedTiltIsKeptUntilASensorConfirmsIt) {
  StationTilt resumed(sensors_only());
  resumed.resume({{radians(0.12), radians(-0.08)}, 2e-4, 0}, 1000.0, 100.0);
  EXPECT_NEAR(pose_of(resumed, 1000.0).tilt_sd_rad, std::hypot(2e-4, 2e-5 * 10.0), 1e-12);
  EXPECT_FALSE(resumed.is_from_sensor());
  resumed.add(tilt(1001.0));
  EXPECT_TRUE(resumed.is_from_sensor());
  EXPECT_THAT(alarms_of(resumed, 1001.0), IsEmpty());
}

PersistedPose example() {
  PersistedPose pose;
  pose.position = {{radians(49.2266123456789), radians(-16.5969), 310.25},
                   {0.021, 0.022, 0.043},
                   1'700'000'000'123'456};
  pose.tilt = {{radians(0.12), radians(-0.08)}, radians(0.01), 1'700'000'000'654'321};
  return pose;
}

std::string error_of(const std::string& text) {
  const auto read = persisted_pose_from(text);
  return std::holds_alternative<std::string>(read) ? std::get<std::string>(read) : "none";
}

// With the sum that belongs to it: a writer's mistake, not a damaged disk.
std::string summed(const std::string& lines) {
  const std::string text = "ols-pose 1\n" + lines;
  char sum[32];
  std::snprintf(sum, sizeof sum, "sum %016lx\n", static_cast<unsigned long>(fnv1a(text)));
  return text + sum;
}

TEST(PersistedPose, ComesBackAsItWas) {
  const PersistedPose pose = example();
  const auto read = persisted_pose_from(to_text(pose));
  ASSERT_TRUE(std::holds_alternative<PersistedPose>(read)) << std::get<std::string>(read);
  const auto& again = std::get<PersistedPose>(read);
  ASSERT_TRUE(again.position && again.tilt);
  EXPECT_NEAR(again.position->ground.latitude_rad, pose.position->ground.latitude_rad, 1e-13);
  EXPECT_NEAR(again.position->ground.longitude_rad, pose.position->ground.longitude_rad, 1e-13);
  EXPECT_NEAR(again.position->ground.height_m, 310.25, 1e-6);
  EXPECT_NEAR((again.position->sd_enu_m - pose.position->sd_enu_m).norm(), 0.0, 1e-7);
  EXPECT_EQ(again.position->utime_us, 1'700'000'000'123'456);
  EXPECT_NEAR((again.tilt->tilt_rad - pose.tilt->tilt_rad).norm(), 0.0, 1e-10);
  EXPECT_NEAR(again.tilt->sd_rad, pose.tilt->sd_rad, 1e-9);
  EXPECT_EQ(again.tilt->utime_us, 1'700'000'000'654'321);
}

TEST(PersistedPose, APartMayBeMissing) {
  PersistedPose pose = example();
  pose.tilt.reset();
  const auto read = persisted_pose_from(to_text(pose));
  ASSERT_TRUE(std::holds_alternative<PersistedPose>(read));
  EXPECT_TRUE(std::get<PersistedPose>(read).position);
  EXPECT_FALSE(std::get<PersistedPose>(read).tilt);
}

TEST(PersistedPose, EveryCutAndEveryWrongByteIsSeen) {
  const std::string text = to_text(example());
  for (std::size_t i = 0; i < text.size(); ++i) {
    EXPECT_NE(error_of(text.substr(0, i)), "none") << i;
    std::string wrong = text;
    wrong[i] = static_cast<char>(wrong[i] ^ 1);
    EXPECT_NE(error_of(wrong), "none") << i;
  }
  EXPECT_NE(error_of(text + "x"), "none");
}

TEST(PersistedPose, NumbersThatAreNoPoseAreRefusedByTheirLine) {
  const std::string good = "tilt 0.1 0.1 0.01 17\n";
  EXPECT_EQ(error_of(summed(good)), "none");
  for (const char* bad :
       {"tilt 91 0.1 0.01 17\n", "tilt nan 0.1 0.01 17\n", "tilt 0.1 0.1 0 17\n",
        "tilt 0.1 0.1 0.01 -1\n", "tilt 0.1 0.1 0.01\n", "tilt 0.1 0.1 0.01 17 18\n",
        "position 91 0 0 1 1 1 17\n", "position 1 2 3 1 1 inf 17\n", "position 1 2 3 1 1 -1 17\n",
        "heading 3\n", "\n"}) {
    EXPECT_EQ(error_of(summed(bad)), "line 2: is neither a position nor a tilt") << bad;
  }
  EXPECT_EQ(error_of(summed(good + good)), "line 3: is neither a position nor a tilt");
}

}  // namespace
}  // namespace ols::sensors
