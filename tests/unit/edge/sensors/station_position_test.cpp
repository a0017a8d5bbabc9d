#include "edge/sensors/station_position.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

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

}  // namespace
}  // namespace ols::sensors
