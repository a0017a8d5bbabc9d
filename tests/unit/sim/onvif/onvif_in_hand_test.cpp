// The product's driver against the simulated camera, by their SOAP texts.
#include "sim/onvif/onvif_in_hand.h"

#include <gtest/gtest.h>

#include "geometry/angles.h"

namespace ols::sim {
namespace {

struct OnvifInHandTest : ::testing::Test {
  OnvifInHandTest() : camera(device, drive_config(device.unit), 1, now_s) {}

  // `pan_deg`: of a goal at rest; nullopt: no goal.
  void run(double seconds, std::optional<double> pan_deg = {}) {
    for (const double end_s = now_s + seconds; now_s < end_s; now_s += 0.005) {
      std::optional<mount::Goal> goal;
      if (pan_deg)
        goal = mount::Goal{now_s, {radians(*pan_deg), 0.0}, {}, now_s + 0.5, false, true};
      camera.drive().set_goal(goal);
      camera.advance(now_s);
      for (const auto& sample : camera.drive().take_samples()) sampled_s = sample.time_s;
    }
  }
  std::string alarms() const {
    std::string text;
    for (const Alarm& alarm : camera.drive().alarms(now_s)) text += alarm.text + "\n";
    return text;
  }

  OnvifConfig device;
  double now_s = 1.0, sampled_s = 0.0;
  OnvifInHand camera;
};

TEST_F(OnvifInHandTest, ARebootInMotionAndOneAtRestAreTold) {
  for (const bool at_rest : {false, true}) {
    run(at_rest ? 40.0 : 4.0, at_rest ? -100.0 : 140.0);
    EXPECT_EQ(alarms(), "");
    if (at_rest) run(5.0);
    camera.set_faults({.reboots = true}, now_s);
    run(device.unit.boot_s + 6.0);
    EXPECT_NE(alarms().find("moved while it was not connected"), std::string::npos) << alarms();
    EXPECT_GT(sampled_s, now_s - 1.0);
    camera.set_faults({}, now_s);
    run(40.0);
  }
}

TEST_F(OnvifInHandTest, APositionThatNeverChangesIsToldForMovesOfEitherKind) {
  for (const double pan_deg : {1.8, 90.0}) {  // an absolute move, and velocities
    camera.set_faults({.frozen = true}, now_s);
    run(5.0, pan_deg);
    EXPECT_NE(alarms().find("does not move as ordered"), std::string::npos) << pan_deg;
    EXPECT_LT(sampled_s, now_s - 0.5);
    camera.set_faults({}, now_s);
    run(60.0, 20.0 + pan_deg);
    EXPECT_EQ(alarms(), "") << pan_deg;
    EXPECT_GT(sampled_s, now_s - 1.0);
    run(30.0, 0.0);
  }
}

}  // namespace
}  // namespace ols::sim
