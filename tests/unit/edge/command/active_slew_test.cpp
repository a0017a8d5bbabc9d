#include "edge/command/active_slew.h"

#include <gtest/gtest.h>

#include "geometry/angles.h"

namespace ols::station {
namespace {

class ActiveSlewTest : public testing::Test {
 protected:
  ActiveSlewTest() {
    config.geometry.position = {radians(49.2), radians(16.6), 250.0};
    config.limits = {-radians(159), radians(159), -radians(46), radians(31)};
    command.received_s = 10.0;
    command.effect_s = 10.05;
    command.lease_s = 0.5;
    command.direction = {radians(-10.0), 0.0};
    command.azimuth_rate_rad_s = -0.1;
  }
  StationConfig config;
  SlewCommand command;
  ActiveSlew slew;
};

TEST_F(ActiveSlewTest, LeadsTheUnitWithItsRateUntilItsLeaseIsOver) {
  const PointingModel pointing(config);
  EXPECT_FALSE(slew.goal(pointing, 10.0)) << "there is none";
  slew.give(command, 10.0);
  const auto goal = slew.goal(pointing, 10.5);
  ASSERT_TRUE(goal);
  EXPECT_EQ(goal->time_s, 10.05);
  EXPECT_NEAR(degrees(goal->angles.pan_rad), 10.0, 1e-3);
  EXPECT_NEAR(goal->rate.pan_rad, 0.1, 1e-4);
  EXPECT_EQ(goal->valid_until_s, 10.5);
  EXPECT_FALSE(slew.goal(pointing, 10.51)) << "over, although expire() has not been called yet";
  slew.expire(10.5);
  EXPECT_TRUE(slew.command());
  slew.expire(10.51);
  EXPECT_FALSE(slew.command());
}

TEST_F(ActiveSlewTest, MovesNothingBeyondTheTravel) {
  config.limits = {-radians(5), radians(5), -radians(46), radians(31)};
  slew.give(command, 10.0);
  EXPECT_FALSE(slew.goal(PointingModel(config), 10.1));
}

}  // namespace
}  // namespace ols::station
