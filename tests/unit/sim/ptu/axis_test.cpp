#include "sim/ptu/axis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ols::sim {
namespace {

constexpr PtuAxis::Profile kProfile{1000.0, 2000.0, 0.0};

// By hand: 0.5 s up to 1000 counts/s over 250 counts, 500 counts at speed, 0.5 s down.
TEST(PtuAxis, TrapezoidByHand) {
  PtuAxis axis(0.0, 10.0);
  axis.move(1000.0, kProfile, 10.0);
  EXPECT_NEAR(axis.position(10.5), 250.0, 1e-9);
  EXPECT_NEAR(axis.velocity(10.5), 1000.0, 1e-9);
  EXPECT_NEAR(axis.position(10.8), 550.0, 1e-9);
  EXPECT_NEAR(axis.position(11.25), 1000.0 - 62.5, 1e-9);
  EXPECT_NEAR(axis.rest_s(), 11.5, 1e-9);
  EXPECT_DOUBLE_EQ(axis.position(20.0), 1000.0);
}

// Too short to reach full speed: a triangle with its peak at sqrt(a d).
TEST(PtuAxis, TriangleByHand) {
  PtuAxis axis(0.0, 0.0);
  axis.move(-200.0, kProfile, 0.0);
  const double half_s = std::sqrt(200.0 / 2000.0);
  EXPECT_NEAR(axis.rest_s(), 2.0 * half_s, 1e-9);
  EXPECT_NEAR(axis.velocity(half_s), -2000.0 * half_s, 1e-6);
}

TEST(PtuAxis, TurnsRoundWhenTheTargetLiesBehind) {
  PtuAxis axis(0.0, 0.0);
  axis.move(5000.0, kProfile, 0.0);
  axis.move(0.0, kProfile, 1.0);  // at 750 with 1000 counts/s: stands at 1000 after 0.5 s
  EXPECT_NEAR(axis.position(1.5), 1000.0, 1e-9);
  EXPECT_NEAR(axis.velocity(1.5), 0.0, 1e-9);
  EXPECT_NEAR(axis.rest_s(), 1.5 + 1.5, 1e-9);
  EXPECT_DOUBLE_EQ(axis.position(9.0), 0.0);
}

TEST(PtuAxis, ASlowerSpeedIsReachedByBraking) {
  PtuAxis axis(0.0, 0.0);
  axis.move(5000.0, kProfile, 0.0);
  axis.move(5000.0, {400.0, 2000.0, 0.0}, 1.0);
  EXPECT_NEAR(axis.velocity(1.1), 800.0, 1e-9);
  EXPECT_NEAR(axis.velocity(1.3), 400.0, 1e-9);
  EXPECT_NEAR(axis.velocity(2.0), 400.0, 1e-9);
}

TEST(PtuAxis, HaltStandsOnAWholeCount) {
  PtuAxis axis(0.0, 0.0);
  axis.move(5000.0, kProfile, 0.0);
  axis.halt(kProfile, 0.777);
  const double end = axis.position(5.0);
  EXPECT_DOUBLE_EQ(end, std::round(end));
  EXPECT_NEAR(end, axis.position(0.777) + 250.0, 1.0);
}

TEST(PtuAxis, BaseSpeedNeedsNoRamp) {
  PtuAxis axis(0.0, 0.0);
  axis.move(1000.0, {1000.0, 2000.0, 200.0}, 0.0);
  EXPECT_NEAR(axis.velocity(0.0), 200.0, 1e-9);
  EXPECT_NEAR(axis.velocity(axis.rest_s() - 1e-9), 200.0, 1e-3);
}

// Commands at any moment: the position is continuous, speed and acceleration stay within their
// bounds, and the axis ends where the last command wanted it.
TEST(PtuAxis, RetargetingKeepsToItsBounds) {
  std::mt19937 random(99);
  std::uniform_real_distribution<double> target(-5000.0, 5000.0), pause(0.001, 0.8);
  const PtuAxis::Profile profile{1500.0, 3000.0, 57.0};
  PtuAxis axis(0.0, 0.0);
  double time_s = 0.0, last = 0.0, last_velocity = 0.0, wanted = 0.0;
  constexpr double kStep_s = 1e-3;
  for (int move = 0; move < 300; ++move) {
    wanted = std::round(target(random));
    if (move % 5 == 4) {
      axis.halt(profile, time_s);
      wanted = axis.target();
    } else {
      axis.move(wanted, profile, time_s);
    }
    const double until_s = time_s + pause(random);
    while (time_s < until_s) {
      time_s += kStep_s;
      const double now = axis.position(time_s), velocity = axis.velocity(time_s);
      ASSERT_LE(std::abs(now - last), profile.speed * kStep_s + 1e-6);
      ASSERT_LE(std::abs(velocity), profile.speed + 1e-6);
      // A start or stop may jump by the base speed, a turn by twice that.
      ASSERT_LE(std::abs(velocity - last_velocity),
                profile.acceleration * kStep_s + 2.0 * profile.base_speed + 1e-6);
      last = now;
      last_velocity = velocity;
    }
    axis.forget(time_s - 1.0);
  }
  EXPECT_DOUBLE_EQ(axis.position(time_s + 20.0), wanted);
}

}  // namespace
}  // namespace ols::sim
