#include "edge/sensors/station_tilt.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "still_tripod.h"

namespace ols::sensors {
namespace {

using test::sensors_only;
using test::surveyed;
using test::tilt;
using testing::ElementsAre;
using testing::IsEmpty;

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

}  // namespace
}  // namespace ols::sensors
