// A cue from outside in the whole site, in simulated time.
#include "sim/lockstep/outside_cue.h"

#include <gtest/gtest.h>

#include <string>

namespace ols::sim {
namespace {

Scenario demo() { return load_scenario(std::string(OLS_SCENARIOS) + "/overview.toml"); }

// By function: docs/cues.md has how long it takes.
TEST(OutsideCue, BringsTheStationsOntoItsTarget) {
  const LeadTimes times = cue_from_outside(demo(), 2, OutsideCueConfig{.elapsed_s = 11.0});
  EXPECT_EQ(times.stations, 4U);
  EXPECT_TRUE(times.complete()) << times.follows.size() << " follow it";
  EXPECT_TRUE(times.located);
}

TEST(OutsideCue, MovesNobodyBeforeTheOperatorsWord) {
  const World world(demo(), 2);
  Lockstep lockstep(world, nobody_designates(world.scenario()));
  fusion::Cue cue;
  cue.id = "outside.target";
  cue.place = geodetic_from_ecef(world.target(0, 1.0).p_ecef);
  cue.horizontal_sd_m = cue.vertical_sd_m = 10.0;
  cue.velocity_sd_m_s = 5.0;
  for (double time_s = 1.0; time_s < 3.0; time_s += 0.2) {
    lockstep.run(time_s);
    cue.state_us = cue.utime_us = Lockstep::kStartUtime_us + std::llround(1e6 * time_s);
    lockstep.hear(cue, time_s);
  }
  EXPECT_EQ(lockstep.fusion().health().counters.at("cues"), 10.0);
  EXPECT_TRUE(lockstep.result().slews.empty());
  EXPECT_TRUE(lockstep.allow_cue(cue.id));
  cue.state_us = cue.utime_us += 200'000;
  lockstep.hear(cue, 3.2);
  EXPECT_EQ(lockstep.result().slews.size(), 4U) << "not the overview station";
}

}  // namespace
}  // namespace ols::sim
