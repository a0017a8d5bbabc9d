#include "edge/process/kept_pose.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "base/process/clocks.h"
#include "edge/sensors/dpg2/dpg2_kind.h"
#include "edge/sensors/gpsd/gpsd_kind.h"
#include "geometry/angles.h"
#include "tests/unit/folder_test.h"

namespace ols::station {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

class KeptPoseTest : public FolderTest<> {
 protected:
  KeptPoseTest() {
    settings_.id = "alfa";
    settings_.state_folder = folder_;
    settings_.gnss.as<sensors::GpsdKind>()->gpsd.host = "localhost";
    settings_.inclinometer.as<sensors::Dpg2Kind>()->dpg2.device = "/dev/dpg2";
  }

  void persist() const {
    sensors::PersistedPose pose;
    const Geodetic ground{radians(49.2), radians(16.6), 250.0};
    pose.position = {ground, Eigen::Vector3d::Constant(0.02), clock_utime_us()};
    pose.tilt = {Eigen::Vector2d(1e-3, 2e-3), 2e-4, clock_utime_us()};
    std::ofstream(folder_ + "/alfa.pose") << to_text(pose);
  }

  StationSettings settings_;
};

TEST_F(KeptPoseTest, WithoutAFileThereIsNoPositionAndAnAlarm) {
  const KeptPose kept(settings_, 10.0);
  EXPECT_EQ(kept.pose(10.0).position_source, sensors::PoseSource::kNone);
  EXPECT_THAT(kept.alarms(10.0), Contains("pose: no position yet, no bearings"));
}

TEST_F(KeptPoseTest, ResumesThePoseOfTheLastRun) {
  persist();
  const KeptPose kept(settings_, 10.0);
  EXPECT_NEAR(kept.pose(10.0).position.height_m, 250.0, 1e-3);
  EXPECT_NEAR(kept.pose(10.0).tilt_y_rad, 2e-3, 1e-6);
  EXPECT_THAT(kept.alarms(10.0), Contains(HasSubstr("restored from before the restart")));
  EXPECT_THAT(kept.alarms(10.0), Not(Contains(HasSubstr("no position yet"))));
}

// The sensor would never confirm it.
TEST_F(KeptPoseTest, WhatAMissingSensorMeasuredIsNotResumed) {
  persist();
  settings_.gnss.as<sensors::GpsdKind>()->gpsd.host.clear();
  EXPECT_EQ(KeptPose(settings_, 10.0).pose(10.0).position_source, sensors::PoseSource::kNone);
  EXPECT_EQ(KeptPose(settings_, 10.0).pose(10.0).tilt_source, sensors::PoseSource::kSensor);
  settings_.gnss.as<sensors::GpsdKind>()->gpsd.host = "localhost";
  settings_.inclinometer.as<sensors::Dpg2Kind>()->dpg2.device.clear();
  EXPECT_EQ(KeptPose(settings_, 10.0).pose(10.0).position_source, sensors::PoseSource::kSensor);
  EXPECT_EQ(KeptPose(settings_, 10.0).pose(10.0).tilt_source, sensors::PoseSource::kNone);
}

TEST_F(KeptPoseTest, AStationIsKnownByItsId) {
  persist();
  settings_.id = "bravo";
  EXPECT_EQ(KeptPose(settings_, 10.0).pose(10.0).position_source, sensors::PoseSource::kNone);
}

TEST_F(KeptPoseTest, ADamagedFileIsAnAlarm) {
  std::ofstream(folder_ + "/alfa.pose") << "ols-pose 1\nposition";
  EXPECT_THAT(KeptPose(settings_, 10.0).alarms(10.0), Contains(HasSubstr("saved pose refused")));
}

}  // namespace
}  // namespace ols::station
