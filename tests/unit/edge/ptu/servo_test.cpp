#include "edge/ptu/servo.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "geometry/angles.h"

namespace ols::ptu {
namespace {

constexpr mount::Limits kLimits{-2.7, 2.7, -0.8, 0.5};

ServoConfig config() {
  ServoConfig servo;
  servo.min_speed_rad_s = 0.0017;
  servo.max_acceleration_rad_s2 = 1.05;
  return servo;
}

mount::Goal goal(const PanTilt& angles, const PanTilt& rate = {}) {
  return {100.0, angles, rate, 100.4};
}

TEST(Servo, CommandsAFixedGoalExactly) {
  const auto command = servo_step(config(), kLimits, goal({0.5, 0.1}), {0.0, 0.2}, 100.0);
  ASSERT_TRUE(command);
  EXPECT_DOUBLE_EQ(command->position.pan_rad, 0.5);
  EXPECT_DOUBLE_EQ(command->position.tilt_rad, 0.1);
  EXPECT_GT(command->speed.pan_rad, command->speed.tilt_rad);
}

TEST(Servo, AsksForNoLessThanTheLeastSpeed) {
  const auto command = servo_step(config(), kLimits, goal({0.5, 0.1}), {0.5, 0.1}, 100.0);
  ASSERT_TRUE(command);
  EXPECT_DOUBLE_EQ(command->speed.pan_rad, 0.0017);
}

// The unit must not begin to brake before the next commands come: its braking distance fits, and
// the look-ahead's travel with it, at every speed.
TEST(Servo, BrakingDistanceFitsInTheLookAhead) {
  const ServoConfig servo = config();
  for (const double rate : {-1.0, -0.3, -0.05, 0.01, 0.1, 0.5, 1.0}) {
    const auto command =
        servo_step(servo, kLimits, goal({0.2, 0.0}, {rate, 0.0}), {0.2, 0.0}, 100.0);
    ASSERT_TRUE(command);
    const double speed = command->speed.pan_rad;
    EXPECT_NEAR(speed, std::abs(rate), 1e-12);
    const double way = (command->position.pan_rad - 0.2) * std::copysign(1.0, rate);
    const double braking = speed * speed / (2.0 * servo.max_acceleration_rad_s2);
    EXPECT_NEAR(way, braking + speed * servo.look_ahead_s, 1e-12);
  }
}

TEST(Servo, WaitsForAGoalThatComesTowardsIt) {
  const auto command =
      servo_step(config(), kLimits, goal({0.2, 0.0}, {0.1, 0.0}), {0.5, 0.0}, 100.0);
  ASSERT_TRUE(command);
  EXPECT_LT(command->position.pan_rad, 0.5);
  EXPECT_GE(command->position.pan_rad, 0.2);
}

TEST(Servo, StaysWithinLimits) {
  const auto beyond =
      servo_step(config(), kLimits, goal({3.0, -2.0}, {0.5, -0.5}), {2.6, -0.7}, 100.0);
  ASSERT_TRUE(beyond);
  EXPECT_DOUBLE_EQ(beyond->position.pan_rad, 2.7);
  EXPECT_DOUBLE_EQ(beyond->position.tilt_rad, -0.8);
  const auto towards =
      servo_step(config(), kLimits, goal({2.69, 0.49}, {1.0, 1.0}), {2.6, 0.4}, 100.0);
  ASSERT_TRUE(towards);
  EXPECT_LE(towards->position.pan_rad, 2.7);
  EXPECT_LE(towards->position.tilt_rad, 0.5);
}

TEST(Servo, HaltsWithoutAUsableGoal) {
  const PanTilt now;
  EXPECT_FALSE(servo_step(config(), kLimits, std::nullopt, now, 100.0));
  EXPECT_TRUE(servo_step(config(), kLimits, goal({0.1, 0.0}), now, 100.4));
  EXPECT_FALSE(servo_step(config(), kLimits, goal({0.1, 0.0}), now, 100.401));
  mount::Goal old = goal({0.1, 0.0});
  old.valid_until_s = 200.0;
  EXPECT_TRUE(servo_step(config(), kLimits, old, now, 100.5));
  EXPECT_FALSE(servo_step(config(), kLimits, old, now, 100.501));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(servo_step(config(), kLimits, goal({nan, 0.0}), now, 100.0));
  EXPECT_FALSE(servo_step(config(), kLimits, goal({0.0, 0.0}, {0.0, nan}), now, 100.0));
  mount::Goal unbounded = goal({0.0, 0.0});
  unbounded.valid_until_s = nan;
  EXPECT_FALSE(servo_step(config(), kLimits, unbounded, now, 100.0));
}

TEST(Servo, CommandsNothingWithinLimitsThatContradictEachOther) {
  const mount::Limits tilt_empty{-2.7, 2.7, 0.7, 0.5}, pan_empty{1.0, 0.9, -0.8, 0.5};
  const mount::Limits unknown{-2.7, 2.7, -0.8, std::nan("")};
  for (const mount::Limits& limits : {tilt_empty, pan_empty, unknown}) {
    EXPECT_FALSE(servo_step(config(), limits, goal({0.5, 0.1}), {0.0, 0.2}, 100.0));
  }
}

mount::Goal resting(const PanTilt& angles) {
  mount::Goal goal{100.0, angles, {}, 100.4};
  goal.rests = true;
  return goal;
}

// On its own ramp: a proportional speed near the goal would take seconds for the last tenths of a
// degree.
TEST(Servo, ARestingGoalIsApproachedAsFastAsTheUnitCanBrake) {
  const ServoConfig servo = config();
  for (const double way_rad : {1e-3, 1e-2, -0.05, 0.2, -0.4}) {
    const double brakable = std::sqrt(2.0 * servo.max_acceleration_rad_s2 * std::abs(way_rad));
    const PanTilt now_rate{0.85 * std::copysign(brakable, way_rad), 0.0};
    const auto command =
        servo_step(servo, kLimits, resting({way_rad, 0.0}), {0.0, 0.0}, 100.0, now_rate);
    ASSERT_TRUE(command);
    EXPECT_DOUBLE_EQ(command->position.pan_rad, way_rad) << "itself, so that the unit stops there";
    EXPECT_LE(command->speed.pan_rad, brakable);
    EXPECT_GT(command->speed.pan_rad, 0.85 * brakable);
  }
}

// From rest: what it speeds up over during the look-ahead, and brakes over then.
TEST(Servo, AStandingUnitIsNotSentFarAtOnce) {
  const ServoConfig servo = config();
  const auto command = servo_step(servo, kLimits, resting({2.0, 0.0}), {0.0, 0.0}, 100.0);
  ASSERT_TRUE(command);
  const double ramp_rad =
      0.5 * servo.max_acceleration_rad_s2 * servo.look_ahead_s * servo.look_ahead_s;
  EXPECT_NEAR(command->position.pan_rad, 2.0 * ramp_rad, 1e-12);
  EXPECT_DOUBLE_EQ(command->speed.pan_rad, servo.max_speed_rad_s);
}

// A host that dies leaves the unit with this command: with the look-ahead's travel and the braking
// distance before it, never with the whole way.
TEST(Servo, ARestingGoalFarAwayIsCommandedInStages) {
  ServoConfig servo = config();
  for (const double max_speed_rad_s : {0.2, 0.5, 1.0}) {
    servo.max_speed_rad_s = max_speed_rad_s;
    for (const double now_rad_s : {-1.0, 0.0, 0.1, max_speed_rad_s}) {
      for (const double way_rad : {-2.6, -1.5, -0.3, 0.05, 0.7, 2.6}) {
        const PanTilt now_rate{std::copysign(now_rad_s, now_rad_s * way_rad), 0.0};
        const auto command =
            servo_step(servo, kLimits, resting({way_rad, 0.0}), {0.0, 0.0}, 100.0, now_rate);
        ASSERT_TRUE(command);
        const double speed = command->speed.pan_rad;
        EXPECT_LE(speed, max_speed_rad_s);
        EXPECT_LE(std::abs(command->position.pan_rad),
                  speed * servo.look_ahead_s +
                      speed * speed / (2.0 * servo.max_acceleration_rad_s2) + 1e-12);
        EXPECT_GT(command->position.pan_rad * way_rad, 0.0);
      }
    }
  }
}

mount::Goal rates(const PanTilt& rate) {
  mount::Goal goal{100.0, {}, rate, 100.4};
  goal.rate_only = true;
  return goal;
}

TEST(Servo, ARateGoesOnFromWhereverTheUnitIs) {
  const auto command = servo_step(config(), kLimits, rates({-0.3, 0.0}), {1.7, 0.2}, 100.0);
  ASSERT_TRUE(command);
  EXPECT_DOUBLE_EQ(command->speed.pan_rad, 0.3);
  EXPECT_NEAR(command->position.pan_rad, 1.7 - 0.3 * 0.3 - 0.09 / 2.1, 1e-12);
  EXPECT_DOUBLE_EQ(command->position.tilt_rad, 0.2);
}

TEST(Servo, ARateEndsAtTheLimitsAndAtARegionsBorder) {
  const auto at_limit = servo_step(config(), kLimits, rates({1.0, 1.0}), {2.6, 0.45}, 100.0);
  ASSERT_TRUE(at_limit);
  EXPECT_DOUBLE_EQ(at_limit->position.pan_rad, 2.7);
  EXPECT_DOUBLE_EQ(at_limit->position.tilt_rad, 0.5);
  mount::Limits limits = kLimits;
  limits.keep_out = {{0.1, 0.5, -0.2, 0.2}};
  const auto at_border = servo_step(config(), limits, rates({1.0, 0.0}), {0.0, 0.0}, 100.0);
  ASSERT_TRUE(at_border);
  EXPECT_LT(at_border->position.pan_rad, 0.1);
  EXPECT_FALSE(servo_step(config(), limits, rates({1.0, 0.0}), {0.3, 0.0}, 100.0)) << "inside";
}

}  // namespace
}  // namespace ols::ptu
