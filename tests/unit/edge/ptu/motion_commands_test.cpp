#include "edge/ptu/motion_commands.h"

#include <gtest/gtest.h>

#include "tests/unit/edge/ptu/unit_replies.h"

namespace ols::ptu {
namespace {

mount::Goal goal(double pan_rad, double time_s) {
  return {time_s, {pan_rad, 0.0}, {}, time_s + 0.5};
}

MotionCommands::Now standing() {
  MotionCommands::Now now;
  now.standing = true;
  return now;
}

// The greatest pan position that is commanded on the way to a goal.
std::int32_t furthest(const PtuConfig& config, double goal_rad) {
  const double step_rad = d46_facts().pan.resolution_rad;
  MotionCommands commands(config, d46_facts());
  MotionCommands::Now now;
  std::int32_t greatest = 0;
  for (int i = 0; i < 400; ++i) {
    const std::string bytes = commands.next(goal(goal_rad, 0.1 * i), now, 0.1 * i).bytes();
    const auto at = bytes.find("PP");
    if (at == std::string::npos) continue;
    greatest = std::max(greatest, std::stoi(bytes.substr(at + 2)));
    now.angles.pan_rad = greatest * step_rad;
  }
  return greatest;
}

TEST(MotionCommands, StaysWithinTheNarrowerOfConfigurationAndUnit) {
  PtuConfig config;
  config.limits.pan_max_rad = 0.5;
  EXPECT_EQ(furthest(config, 2.0), static_cast<int>(0.5 / d46_facts().pan.resolution_rad));
  config.limits.pan_max_rad = 10.0;
  EXPECT_EQ(furthest(config, 9.0), d46_facts().pan.max);
}

TEST(MotionCommands, SendsWhatHasChangedAndEverythingOnceASecond) {
  MotionCommands commands(PtuConfig{}, d46_facts());
  const auto next = [&](double t) { return commands.next(goal(1.0, t), {}, t).bytes(); };
  const std::string all = next(1.0);
  EXPECT_EQ(all.substr(0, 2), "PS");
  EXPECT_NE(all.find(" TS"), std::string::npos);
  EXPECT_NE(all.find(" PP"), std::string::npos);
  EXPECT_NE(all.find(" TP"), std::string::npos);
  EXPECT_EQ(next(1.5), "");
  EXPECT_EQ(next(2.01), all);
  commands.send_all_again();
  EXPECT_EQ(next(2.1), all);
}

TEST(MotionCommands, HaltsWithoutAGoalAndWithAStaleOne) {
  for (const std::optional<mount::Goal>& stale : {std::optional<mount::Goal>(), {goal(1.0, 0.0)}}) {
    MotionCommands commands(PtuConfig{}, d46_facts());
    EXPECT_EQ(commands.next(stale, {}, 0.6).bytes(), "H ");
  }
}

TEST(MotionCommands, RepeatsTheHaltUntilTheUnitStands) {
  MotionCommands commands(PtuConfig{}, d46_facts());
  EXPECT_EQ(commands.halt({}, 1.0).bytes(), "H ");
  EXPECT_EQ(commands.halt({}, 1.1).bytes(), "");
  EXPECT_EQ(commands.halt(standing(), 9.0).bytes(), "");
  EXPECT_EQ(commands.halt({}, 9.0).bytes(), "H ");  // it ought to have stopped by now
  EXPECT_EQ(commands.halt_again({}, 9.01).bytes(), "H ");
}

TEST(MotionCommands, LowersTheSpeedOfAUnitThatBrakesTooSlowly) {
  PtuFacts facts = d46_facts();
  EXPECT_FALSE(MotionCommands(PtuConfig{}, facts).lowered_speed());
  facts.tilt.acceleration = 2000;
  const auto lowered = MotionCommands(PtuConfig{}, facts).lowered_speed();
  ASSERT_TRUE(lowered);
  EXPECT_NEAR(lowered->acceleration_rad_s2, 2000 * facts.tilt.resolution_rad, 1e-12);
  ServoConfig servo;
  servo.max_acceleration_rad_s2 = lowered->acceleration_rad_s2;
  EXPECT_LE(runs_on_s(servo, lowered->speed_rad_s), kRunsOnAtMost_s + 1e-9);
}

TEST(MotionCommands, SaysWhichLimitsLeaveNoRoom) {
  EXPECT_EQ(limits_conflict(mount::Limits{}, d46_facts()), "");
  const std::string pan = limits_conflict({3.0, 4.0, -0.8, 0.5}, d46_facts());
  EXPECT_NE(pan.find("no pan lies within both"), std::string::npos) << pan;
}

}  // namespace
}  // namespace ols::ptu
