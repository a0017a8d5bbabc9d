// Servo, driver and angle history against the simulated unit: how well it follows, how it stops,
// how well its angles are known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "tests/unit/edge/ptu/closed_loop.h"

namespace ols::ptu {
namespace {

PtuConfig brisk() {  // 60 deg/s^2
  PtuConfig config = quick_driver();
  config.acceleration_rad_s2 = radians(60.0);
  return config;
}

using Trajectory = std::function<mount::Goal(double)>;

// Runs the trajectory (seconds since now -> angles and rate) with a goal every 1/15 s, as a camera
// gives them; returns the largest pan error after `settle_s` [deg].
double follow(ClosedLoop& loop, double duration_s, double settle_s, const Trajectory& trajectory) {
  const double begin_s = loop.time_s;
  double next_goal_s = begin_s;
  double worst_rad = 0.0;
  loop.run(duration_s, [&] {
    const double t = loop.time_s - begin_s;
    mount::Goal now = trajectory(t);
    if (loop.time_s >= next_goal_s) {
      now.time_s = loop.time_s;
      now.valid_until_s = loop.time_s + 0.5;
      loop.driver.set_goal(now);
      next_goal_s += 1.0 / 15.0;
    }
    if (t > settle_s) {
      worst_rad = std::max(worst_rad, std::abs(loop.truth().pan_rad - now.angles.pan_rad));
    }
  });
  return degrees(worst_rad);
}

Trajectory ramp(double from_rad, double rate_rad_s) {
  return [=](double t) {
    return mount::Goal{0.0, {from_rad + rate_rad_s * t, 0.0}, {rate_rad_s, 0.0}, 0.0};
  };
}

TEST(Tracking, StepArrivesWithoutOvershootAndStands) {
  ClosedLoop loop(brisk(), quick_unit());
  ASSERT_TRUE(loop.start());
  double furthest_rad = 0.0;
  loop.run(4.0, [&] {
    loop.driver.set_goal(loop.goal({radians(30.0), radians(-10.0)}));
    furthest_rad = std::max(furthest_rad, loop.truth().pan_rad);
  });
  EXPECT_NEAR(degrees(loop.truth().pan_rad), 30.0, 0.0033);
  EXPECT_NEAR(degrees(loop.truth().tilt_rad), -10.0, 0.0033);
  EXPECT_LT(degrees(furthest_rad), 30.0 + 0.0033);
  // Standing: it does not dither about the goal.
  const PanTilt at = loop.truth();
  loop.run(1.0, [&] {
    loop.driver.set_goal(loop.goal({radians(30.0), radians(-10.0)}));
    ASSERT_DOUBLE_EQ(loop.truth().pan_rad, at.pan_rad);
  });
}

TEST(Tracking, RampIsFollowedClosely) {
  ClosedLoop loop(brisk(), quick_unit());
  ASSERT_TRUE(loop.start());
  EXPECT_LT(follow(loop, 8.0, 2.5, ramp(0.0, radians(10.0))), 0.05);
}

TEST(Tracking, RampIsFollowedCloselyAt9600Baud) {
  PtuConfig config = brisk();
  config.baud = 9600;
  ClosedLoop loop(config, quick_unit(9600));
  ASSERT_TRUE(loop.start());
  EXPECT_LT(follow(loop, 8.0, 2.5, ramp(0.0, radians(10.0))), 0.05);
}

TEST(Tracking, SpeedOnARampIsSmooth) {
  ClosedLoop loop(brisk(), quick_unit());
  ASSERT_TRUE(loop.start());
  follow(loop, 3.0, 3.0, ramp(0.0, radians(10.0)));
  double slowest = 1e9, fastest = 0.0;
  double last = loop.truth().pan_rad;
  const auto ramp_on = ramp(loop.truth().pan_rad, radians(10.0));
  const double begin_s = loop.time_s;
  loop.run(3.0, [&] {
    mount::Goal goal = ramp_on(loop.time_s - begin_s);
    goal.time_s = loop.time_s;
    goal.valid_until_s = loop.time_s + 0.5;
    loop.driver.set_goal(goal);
    if (loop.time_s == begin_s) return;
    const double speed = degrees(loop.truth().pan_rad - last) / ClosedLoop::kTick_s;
    last = loop.truth().pan_rad;
    slowest = std::min(slowest, speed);
    fastest = std::max(fastest, speed);
  });
  EXPECT_GT(slowest, 9.0);
  EXPECT_LT(fastest, 11.0);
}

// 10 deg/s at the peak and back, over 20 degrees: turning points and a crossing of zero speed.
TEST(Tracking, SinusoidStaysNearTheMiddleOfThePicture) {
  for (const int baud : {9600, 38400}) {
    PtuConfig config = brisk();
    config.baud = baud;
    ClosedLoop loop(config, quick_unit(baud));
    ASSERT_TRUE(loop.start());
    const double amplitude = radians(10.0);
    const double omega = 1.0;  // [rad/s]
    const double worst_deg = follow(loop, 16.0, 3.0, [&](double t) {
      return mount::Goal{0.0,
                         {amplitude * std::sin(omega * t), 0.0},
                         {amplitude * omega * std::cos(omega * t), 0.0},
                         0.0};
    });
    EXPECT_LT(worst_deg, 0.35) << baud;
  }
}

TEST(Tracking, CreepsAlongWithASlowGoal) {
  ClosedLoop loop(brisk(), quick_unit());
  ASSERT_TRUE(loop.start());
  EXPECT_LT(follow(loop, 6.0, 1.0, ramp(0.0, radians(0.05))), 0.02);
  EXPECT_LT(follow(loop, 6.0, 1.0, ramp(loop.truth().pan_rad, radians(0.2))), 0.03);
}

TEST(Tracking, StopsAtTheLimitOfItsTravel) {
  PtuConfig config = brisk();
  config.limits.pan_max_rad = radians(20.0);
  ClosedLoop loop(config, quick_unit());
  ASSERT_TRUE(loop.start());
  double furthest_rad = 0.0;
  follow(loop, 4.0, 0.0, [&](double t) {
    furthest_rad = std::max(furthest_rad, loop.truth().pan_rad);
    return mount::Goal{0.0, {radians(10.0) * t, 0.0}, {radians(10.0), 0.0}, 0.0};
  });
  EXPECT_NEAR(degrees(loop.truth().pan_rad), 20.0, 0.0033);
  EXPECT_LE(degrees(furthest_rad), 20.0 + 1e-9);
  EXPECT_EQ(loop.driver.counters().errors, 0u);
}

// The master dies: nothing is sent any more, not even a halt. How long the unit still moves [s].
double moves_on(ClosedLoop& loop) {
  const double died_s = loop.time_s;
  double moved_until_s = died_s;
  double last = loop.truth().pan_rad;
  while (loop.time_s < died_s + 2.0) {
    loop.time_s += ClosedLoop::kTick_s;
    loop.unit.transmit(loop.time_s);
    if (loop.truth().pan_rad != last) moved_until_s = loop.time_s;
    last = loop.truth().pan_rad;
  }
  return moved_until_s - died_s;
}

// With the defaults and with what the simulated site's stations have, at both rates.
TEST(Tracking, StopsByItselfWhenTheMasterDies) {
  for (const double acceleration_rad_s2 : {PtuConfig{}.acceleration_rad_s2, radians(60.0)}) {
    for (const int baud : {9600, 38400}) {
      PtuConfig config = quick_driver(baud);
      config.acceleration_rad_s2 = acceleration_rad_s2;
      ClosedLoop loop(config, quick_unit(baud));
      ASSERT_TRUE(loop.start());
      follow(loop, 4.0, 4.0, ramp(0.0, radians(20.0)));
      const double moved_s = moves_on(loop);
      EXPECT_GT(moved_s, 0.3);  // was moving
      EXPECT_LE(moved_s, 1.0);
      EXPECT_LE(moved_s, ServoConfig{}.look_ahead_s + radians(20.0) / acceleration_rad_s2 + 0.05);
      EXPECT_LE(moved_s,
                runs_on_s({.max_acceleration_rad_s2 = acceleration_rad_s2}, radians(20.0)));
    }
  }
}

TEST(Tracking, StopsByItselfOnALongWayToARestingGoal) {
  ClosedLoop loop(brisk(), quick_unit());
  ASSERT_TRUE(loop.start());
  loop.run(1.8, [&] { loop.driver.set_goal(loop.goal({radians(150.0), 0.0})); });
  const double at_deg = degrees(loop.truth().pan_rad);
  EXPECT_GT(at_deg, 40.0);
  EXPECT_LE(moves_on(loop), 1.0 / 3.0 + degrees(1.0) / 60.0 + 0.05);
  EXPECT_LT(degrees(loop.truth().pan_rad), at_deg + 50.0);
}

mount::Goal resting_at(const ClosedLoop& loop, double pan_deg) {
  mount::Goal goal = loop.goal({radians(pan_deg), 0.0});
  goal.rests = true;
  return goal;
}

// How long a unit that speeds up and brakes evenly needs at least for a way from rest to rest.
double ideal_s(double way_rad, double max_speed_rad_s, double acceleration_rad_s2) {
  const double ramps_rad = max_speed_rad_s * max_speed_rad_s / acceleration_rad_s2;
  if (way_rad < ramps_rad) return 2.0 * std::sqrt(way_rad / acceleration_rad_s2);
  return way_rad / max_speed_rad_s + max_speed_rad_s / acceleration_rad_s2;
}

TEST(Tracking, RestsHardlyLaterThanTheUnitsOwnRampTakes) {
  for (const double way_deg : {1.0, 4.0, 15.0, 60.0, 140.0}) {
    const PtuConfig config = brisk();
    ClosedLoop loop(config, quick_unit());
    ASSERT_TRUE(loop.start());
    const double began_s = loop.time_s;
    double moved_s = 0.0, last_rad = 0.0, furthest_rad = 0.0;
    loop.run(8.0, [&] {
      loop.driver.set_goal(resting_at(loop, way_deg));
      if (loop.truth().pan_rad != last_rad) moved_s = loop.time_s - began_s;
      last_rad = loop.truth().pan_rad;
      furthest_rad = std::max(furthest_rad, last_rad);
    });
    EXPECT_NEAR(degrees(last_rad), way_deg, 0.0033);
    EXPECT_LT(degrees(furthest_rad), way_deg + 0.0033) << "no overshoot";
    const double least_s = ideal_s(radians(way_deg), config.servo.max_speed_rad_s, radians(60.0));
    EXPECT_LT(moved_s, 1.2 * least_s + 0.15) << way_deg;
  }
}

// Whenever the master dies: at the start, at full speed, while the unit brakes.
TEST(Tracking, StopsByItselfOnItsWayToRest) {
  for (const double way_deg : {2.0, 10.0, 150.0}) {
    for (const double died_s : {0.1, 0.2, 0.4, 0.7, 1.0, 1.6, 2.4}) {
      ClosedLoop loop(brisk(), quick_unit());
      ASSERT_TRUE(loop.start());
      loop.run(died_s, [&] { loop.driver.set_goal(resting_at(loop, way_deg)); });
      const double at_rad = loop.truth().pan_rad;
      const ServoConfig servo{.max_acceleration_rad_s2 = radians(60.0)};
      const double braking_rad =
          servo.max_speed_rad_s * servo.max_speed_rad_s / (2.0 * radians(60.0));
      EXPECT_LE(moves_on(loop), runs_on_s(servo, servo.max_speed_rad_s)) << way_deg << died_s;
      EXPECT_LE(loop.truth().pan_rad - at_rad,
                servo.max_speed_rad_s * servo.look_ahead_s + braking_rad + 0.1);
    }
  }
}

// A host that looks at the line every 80 ms cannot tell when a reply came: the link is up, but the
// angles grow old, and the servo does not steer by old ones.
TEST(Tracking, AHostThatReadsLateLetsTheUnitStand) {
  ClosedLoop loop(brisk(), quick_unit());
  ASSERT_TRUE(loop.start());
  follow(loop, 2.0, 2.0, ramp(0.0, radians(10.0)));
  std::string unread;
  const auto read_late = [&](double duration_s) {
    for (int ms = 0; ms < static_cast<int>(duration_s * 1e3); ++ms) {
      loop.time_s += ClosedLoop::kTick_s;
      unread += loop.unit.transmit(loop.time_s);
      if (ms % 80 != 0) continue;
      loop.driver.set_goal(loop.goal({radians(90.0), 0.0}, {radians(10.0), 0.0}));
      loop.driver.receive(std::exchange(unread, {}), loop.time_s);
      const std::string request = loop.driver.step(loop.time_s);
      if (!request.empty()) loop.unit.receive(request, loop.time_s);
    }
  };
  read_late(1.5);
  const PanTilt at = loop.truth();
  read_late(3.0);
  EXPECT_DOUBLE_EQ(loop.truth().pan_rad, at.pan_rad);
  EXPECT_LT(degrees(at.pan_rad), 40.0);
  EXPECT_EQ(loop.driver.state(), PtuState::kReady) << loop.driver.last_error();
  follow(loop, 5.0, 5.0, [](double) { return mount::Goal{0.0, {radians(60.0), 0.0}, {}, 0.0}; });
  EXPECT_NEAR(degrees(loop.truth().pan_rad), 60.0, 0.01);
}

}  // namespace
}  // namespace ols::ptu
