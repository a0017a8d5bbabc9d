#include "sim/ptu/motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sim/ptu/axis.h"
#include "tests/unit/sim/ptu/master.h"

namespace ols::sim {
namespace {

TEST(PtuMotion, MovesAtItsSpeedAndCanBeSentElsewhereOnTheWay) {
  Master master(ready_unit());
  master.ask("PA20000 PS1000 ", 1.0);
  EXPECT_EQ(master.ask("PP5000 ", 1.0), "*\r\n");
  EXPECT_EQ(master.ask("PD ", 0.1), "* 1000\r\n");
  master.ask("PS500 ", 0.5);
  EXPECT_EQ(master.ask("PD PO ", 0.1), "* 500\r\n* 5000\r\n");
  master.ask("PP-100 ", 10.0);
  EXPECT_DOUBLE_EQ(std::round(master.pan_counts()), -100.0);
  master.ask("PO-50 ", 2.0);
  EXPECT_EQ(master.ask("PP "), "* -150\r\n");
}

TEST(PtuMotion, RefusesANewAccelerationInMotion) {
  Master master(ready_unit());
  EXPECT_EQ(master.ask("PP5000 PA9000 ", 0.2), "*\r\n! Illegal Command Entered\r\n");
}

TEST(PtuMotion, HaltsOneAxisOrBoth) {
  Master master(ready_unit());
  master.ask("PP20000 TP5000 ", 1.0);
  master.ask("HP ", 1.0);
  EXPECT_EQ(master.ask("PD TD ", 0.1), "* 0\r\n* 1000\r\n");
  master.ask("H ", 1.0);
  EXPECT_EQ(master.ask("TD ", 0.1), "* 0\r\n");
}

TEST(PtuMotion, SlavedMovesBeginTogetherAndAwaitBlocks) {
  Master master(ready_unit());
  EXPECT_EQ(master.ask("S PP1000 TP500 ", 1.0), "*\r\n*\r\n*\r\n");
  EXPECT_DOUBLE_EQ(master.pan_counts(), 0.0);
  EXPECT_EQ(master.ask("A PP ", 0.5), "");  // still on the way
  EXPECT_EQ(master.wait(3.0), "*\r\n* 1000\r\n");
}

TEST(PtuMotion, VelocityModeRunsIntoTheLimit) {
  Master master(ready_unit());
  EXPECT_EQ(master.ask("PA20000 CV C ", 1.0), "*\r\n*\r\n* p\r\n");
  master.ask("PS-18000 ", 0.5);
  EXPECT_LT(master.pan_counts(), -1000.0);
  EXPECT_EQ(master.wait(10.0), "!P");
  EXPECT_EQ(master.ask("PP "), "* -49467\r\n");
}

TEST(PtuMotion, HomesAtPowerUpBeforeItAnswers) {
  PtuUnitConfig config = ready_unit();
  config.home_at_power_up = true;
  Master master(config);
  master.unit.receive("PP ", master.time_s);
  std::string said = master.wait(60.0);
  EXPECT_EQ(said, "!T!T!P!P*\r\n* 0\r\n");
  EXPECT_EQ(master.ask("R ", 60.0), "!T!T!P!P*\r\n");
}

TEST(PtuMotion, OffsetsOfSpeedCountFromTheSpeedItHas) {
  Master master(ready_unit());
  EXPECT_EQ(master.ask("PS1000 PD900 PS "), "*\r\n*\r\n* 900\r\n");
  EXPECT_EQ(master.ask("CV PS700 ", 1.0), "*\r\n*\r\n");
  EXPECT_EQ(master.ask("PD-200 PS ", 1.0), "*\r\n* 500\r\n");
  EXPECT_EQ(master.ask("PS-500 ", 2.0), "*\r\n");
  EXPECT_EQ(master.ask("PD "), "* -500\r\n");
  EXPECT_EQ(master.ask("PS0 ", 1.0), "*\r\n");
  EXPECT_EQ(master.ask("PD PP100 "), "* 0\r\n! Illegal Command Entered\r\n");
}

TEST(PtuMotion, QueriesOfTargetsFollowSlavedCommands) {
  Master master(ready_unit());
  EXPECT_EQ(master.ask("S PP800 PO TO PP ", 0.5), "*\r\n*\r\n* 800\r\n* 0\r\n* 0\r\n");
  EXPECT_EQ(master.ask("H PO I ", 0.5), "*\r\n* 0\r\n*\r\n");  // a halt drops them
  EXPECT_DOUBLE_EQ(master.pan_counts(), 0.0);
}

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
