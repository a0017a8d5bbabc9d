// A PTU-E46: what it says and does otherwise than a D46. The first captures are of real E-series
// units.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/sim/ptu/master.h"

namespace ols::sim {
namespace {

PtuUnitConfig e46() {
  PtuUnitConfig config = ready_unit();
  config.model = PtuModel::kE46;
  return config;
}

TEST(PtuE46, CaptureWithEchoOn) {
  PtuUnitConfig config = e46();
  config.echo = true;
  Master master(config);
  master.ask("PP100 TP600 ", 5.0);
  EXPECT_EQ(master.ask("PP\r\n"), "PP\r\n* 100\r\n");
  EXPECT_EQ(master.ask("PP TP\r\n"), "PP * 100\r\nTP\r\n* 600\r\n");
  EXPECT_EQ(master.ask("ED FT I CI\r\n"), "ED *\r\n*\r\n*\r\n*\r\n");
}

TEST(PtuE46, CaptureWithEchoOffAndBareCarriageReturns) {
  PtuUnitConfig config = e46();
  config.resolution_arcsec = 23.142857;
  config.pan_min_counts = config.tilt_min_counts = -100;
  config.pan_max_counts = config.tilt_max_counts = 100;
  Master master(config);
  EXPECT_EQ(master.ask("ED\r"), "\n*\r\n");
  EXPECT_EQ(master.ask("PR\r"), "\n* 23.142857\r\n");
  EXPECT_EQ(master.ask("XYZ\r"), "\n! Illegal Command Entered\r\n");
  EXPECT_EQ(master.ask("RT\r", 10.0), "\n!T!T*\r\n");
  EXPECT_EQ(master.ask("O\r"), "\n* 13.2,99,97,104\r\n");
}

TEST(PtuE46, Banner) {
  PtuUnitConfig config = e46();
  config.echo = config.verbose = config.home_at_power_up = true;
  Master master(config);
  const std::string said = master.first + master.wait(60.0);
  EXPECT_NE(said.find("### PAN-TILT CONTROLLER\r\n### v3.3.0, (C)2010-2011 FLIR"),
            std::string::npos);
  EXPECT_NE(said.find("Initializing...!T!T!P!P*\r\n"), std::string::npos);
}

TEST(PtuE46, Verbosely) {
  PtuUnitConfig config = e46();
  config.verbose = true;
  config.resolution_arcsec = 11.571429;
  Master master(config);
  EXPECT_EQ(master.ask("PR "), "* 11.571429 seconds arc per position\r\n");
  EXPECT_EQ(master.ask("C CV C CI ", 0.5),
            "* Independent speed control mode\r\n*\r\n* Pure Velocity speed control mode\r\n*\r\n");
  EXPECT_EQ(master.ask("PS18701 "), "! Pan speed cannot exceed 18700 positions/sec\r\n");
  EXPECT_EQ(master.ask("WP WT "), "* Pan in EIGHTH step mode\r\n* Tilt in EIGHTH step mode\r\n");
  EXPECT_EQ(master.ask("PA "), "* Pan acceleration is 2000 positions/sec/sec\r\n");
  EXPECT_EQ(master.ask("VV "), "* 3.3.0\r\n");
}

TEST(PtuE46, HomesAnAxisAtOnce) {
  Master master(e46());
  master.ask("PP900 TP800 ", 5.0);
  EXPECT_EQ(master.ask("RP ", 60.0), "!P!P*\r\n");
  EXPECT_EQ(master.ask("PP TP "), "* 0\r\n* 800\r\n");
  EXPECT_EQ(master.ask("RT ", 60.0), "!T!T*\r\n");
  EXPECT_EQ(master.ask("RS ", 19.0), "!T!T!P!P*\r\n");  // both at once: sooner than R
  EXPECT_EQ(master.ask("R ", 19.0).find("*"), std::string::npos);
  EXPECT_EQ(master.wait(10.0), "*\r\n");
  EXPECT_EQ(master.ask("RQ RE RQ RD RQ "), "* D\r\n*\r\n* E\r\n*\r\n* D\r\n");
  EXPECT_EQ(master.ask("RPS9000 RPS RTS0 "), "*\r\n* 9000\r\n! Illegal argument\r\n");
}

TEST(PtuE46, RefusesPositionsUntilItHasHomed) {
  PtuUnitConfig config = e46();
  config.homed_before = false;
  Master master(config);
  EXPECT_EQ(master.ask("PP PP100 TO5 B "),
            "! Axis Error\r\n! Axis Error\r\n! Axis Error\r\n! Axis Error\r\n");
  EXPECT_EQ(master.ask("PS "), "* 1000\r\n");
  EXPECT_EQ(master.ask("RP PP ", 60.0), "!P!P*\r\n* 0\r\n");
  EXPECT_EQ(master.ask("TP "), "! Axis Error\r\n");
}

TEST(PtuE46, CoarserStepsHoldFromTheNextResetOn) {
  Master master(e46());
  EXPECT_EQ(master.ask("WPQ WP PR PX "), "*\r\n* Q\r\n* 11.571400\r\n* 49467\r\n");
  master.ask("RP ", 60.0);
  EXPECT_EQ(master.ask("PR PX PU TX "), "* 23.142800\r\n* 24733\r\n* 9350\r\n* 9644\r\n");
  EXPECT_EQ(master.ask("PS5000 PA20000 PP1000 A PP ", 10.0), "*\r\n*\r\n*\r\n*\r\n* 1000\r\n");
  EXPECT_DOUBLE_EQ(std::round(master.pan_counts()), 2000.0);
  EXPECT_EQ(master.ask("WPX WTA "), "! Illegal argument\r\n*\r\n");
}

TEST(PtuE46, MovesBothAxesWithOneCommand) {
  Master master(e46());
  master.ask("PA20000 TA20000 ", 1.0);
  EXPECT_EQ(master.ask("B2000,-1000,5000,4000 A B ", 10.0), "*\r\n*\r\n* P(2000,-1000) S(0,0)\r\n");
  EXPECT_EQ(master.ask("PS TS "), "* 5000\r\n* 4000\r\n");
  EXPECT_EQ(master.ask("BT ").rfind("* P(2000,-1000) S(0,0) ", 0), 0U);
  EXPECT_EQ(master.ask("B1,2,3 "), "! Illegal argument\r\n");
}

TEST(PtuE46, HoldsToLimitsOfItsUser) {
  Master master(e46());
  EXPECT_EQ(master.ask("PNU-500 PXU600 PNU PXU "), "*\r\n*\r\n* -500\r\n* 600\r\n");
  EXPECT_EQ(master.ask("PP700 ", 2.0), "*\r\n");
  EXPECT_EQ(master.ask("LU L PN PP700 "),
            "*\r\n* Limit bounds are ENABLED (user limits enabled)\r\n* -500\r\n"
            "! Maximum allowable Pan position is 600\r\n");
  EXPECT_EQ(master.ask("LE PNU5 TXU-1 "),
            "*\r\n! Illegal argument\r\n! Illegal argument\r\n");  // zero must be within
}

TEST(PtuE46, MonitorEncoderAndModesCanBeAskedFor) {
  Master master(e46());
  EXPECT_EQ(master.ask("MS "), "* Monitor is DISABLED\r\n");
  EXPECT_EQ(master.ask("M-100,100 ", 0.5), "*\r\n");
  EXPECT_EQ(master.ask("MS ", 1.0), "* Monitor is DISABLED\r\n");  // the question has ended it
  EXPECT_EQ(master.ask("CT CEC CT "),
            "* Encoder correction is DISABLED\r\n*\r\n* Encoder correction is ENABLED\r\n");
  EXPECT_EQ(master.ask("IQ S IQ "), "* I\r\n*\r\n* S\r\n");
  EXPECT_EQ(master.ask("CNF "), "* 90000000\r\n");
  EXPECT_EQ(master.ask("CNT ").rfind("* ", 0), 0U);
}

TEST(PtuE46, TakesAccelerationsOnTheWay) {
  Master master(e46());
  EXPECT_EQ(master.ask("PP5000 PA9000 ", 0.2), "*\r\n*\r\n");
}

}  // namespace
}  // namespace ols::sim
