#include "sim/ptu/motion.h"

#include <gtest/gtest.h>

#include <cmath>

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

}  // namespace
}  // namespace ols::sim
