// A unit in simulated time, as the driver sees it.
#include "sim/lockstep/lockstep_mount.h"

#include <gtest/gtest.h>

#include "sim/scenario/scenario.h"

namespace ols::sim {
namespace {

// Of a unit that turns, the driver's angles neither lead nor lag.
TEST(LockstepMount, AnglesAreThoseOfTheirTimes) {
  const World world(load_scenario(std::string(OLS_SCENARIOS) + "/fig7.toml"), 1);
  const auto mount = make_lockstep_mount(world, 0, 1, 0.0);
  constexpr double kTurn_s = 0.001, kRate_rad_s = 0.3;
  double sum_s = 0.0;
  int count = 0;
  for (int tick = 1; tick < 6000; ++tick) {
    const double now_s = tick * kTurn_s;
    mount->advance(now_s);
    mount->set_goal(mount::Goal{.time_s = now_s,
                                .rate = {kRate_rad_s, 0.0},
                                .valid_until_s = now_s + 1.0,
                                .rate_only = true});
    for (const mount::AngleSample& sample : mount->take_samples()) {
      if (now_s < 3.0) continue;  // it starts, and gathers speed
      const double true_rad = mount->angles_at(sample.time_s).pan_rad;
      sum_s += (sample.angles.pan_rad - true_rad) / kRate_rad_s;
      ++count;
    }
  }
  ASSERT_GT(count, 100);
  EXPECT_NEAR(sum_s / count, 0.0, 1.5e-4);
}

// The first station of mixed.toml is an ONVIF camera: it goes where it is ordered, and says where
// it is, but for its repeatability of 0.05 deg.
TEST(LockstepMount, AnOnvifCameraIsDrivenByItsMessages) {
  const World world(load_scenario(std::string(OLS_SCENARIOS) + "/mixed.toml"), 1);
  const auto mount = make_lockstep_mount(world, 0, 1, 0.0);
  const PanTilt there{radians(20.0), radians(10.0)};
  mount::AngleSample newest;
  for (double now_s = 0.0; now_s < 10.0; now_s += 0.001) {
    mount->advance(now_s);
    mount->set_goal(mount::Goal{.time_s = now_s, .angles = there, .valid_until_s = now_s + 1.0});
    for (const auto& sample : mount->take_samples()) newest = sample;
  }
  EXPECT_TRUE(mount->limits());
  EXPECT_NEAR(newest.place_sd.pan_rad, radians(0.05), 1e-9) << "as configured";
  const PanTilt true_angles = mount->angles_at(newest.time_s);
  EXPECT_NEAR(true_angles.pan_rad, there.pan_rad, radians(0.2));
  EXPECT_NEAR(newest.angles.pan_rad, true_angles.pan_rad, radians(0.2));
  EXPECT_NE(newest.angles.pan_rad, true_angles.pan_rad);
}

}  // namespace
}  // namespace ols::sim
