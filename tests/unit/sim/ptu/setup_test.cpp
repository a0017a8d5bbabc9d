#include "sim/ptu/setup.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/ptu/controller.h"
#include "sim/ptu/presets.h"
#include "sim/ptu/scan.h"
#include "tests/unit/sim/ptu/master.h"

namespace ols::sim {
namespace {

TEST(PtuUnitId, OneThatIsNotSelectedIsSilent) {
  PtuUnitConfig config = ready_unit();
  config.echo = true;
  Master master(config);
  EXPECT_EQ(master.ask("U U5 U "), "U * 0\r\nU5 *\r\nU * 5\r\n");
  EXPECT_EQ(master.ask("_5 PP "), "_5 *\r\nPP * 0\r\n");
  EXPECT_EQ(master.ask("_4 PP1000 XYZ TP ", 2.0), "_4 ");
  EXPECT_DOUBLE_EQ(master.pan_counts(), 0.0);
  EXPECT_EQ(master.ask("_5 "), "*\r\n");
  // As published for units that are no longer sold.
  master.ask("_4 DS ");
  EXPECT_EQ(master.ask(" _0 u0 DS R ", 60.0).substr(0, 3), "*\r\n");
  EXPECT_EQ(master.ask("U "), "U * 0\r\n");
}

TEST(PtuUnitId, OneWithAnIdIsSilentFromPowerUpOn) {
  Master master(ready_unit());
  master.ask("U7 DS ");
  PtuFaults power;
  power.power_cycle = true;
  master.set(power);
  EXPECT_EQ(master.ask("PP ", 2.0), "");
  EXPECT_EQ(master.ask("_7 PP "), "*\r\n* 0\r\n");
}

TEST(PtuHoming, IsChosenForEachAxis) {
  Master master(ready_unit());
  EXPECT_EQ(master.ask("RT "), "*\r\n");  // a D46 moves nothing now
  PtuFaults power;
  power.power_cycle = true;
  master.set(power);
  const std::string said = master.wait(30.0);
  EXPECT_EQ(said.substr(said.rfind('\n', said.size() - 2) + 1), "!T!T*\r\n") << said;
  master.set({});
  EXPECT_EQ(master.ask("RE "), "*\r\n");
  master.set(power);
  EXPECT_NE(master.wait(60.0).find("!T!T!P!P*\r\n"), std::string::npos);
}

TEST(PtuModes, FeedbackCanBeSwitchedOff) {
  Master master(ready_unit());
  EXPECT_EQ(master.ask("FO PP1000 XYZ PP ", 3.0), "");
  EXPECT_DOUBLE_EQ(std::round(master.pan_counts()), 1000.0);
  EXPECT_EQ(master.ask("FT PP "), "*\r\n* 1000\r\n");
}

TEST(PtuHostPort, KeepsANewRateForPowerUpWhenToldTo) {
  Master master(ready_unit());
  master.unit.set_master_baud(19200);
  PtuFaults power;
  for (const auto& [command, rate] :
       {std::pair("@(19200,0,T) ", 19200), std::pair("@(9600,0,F) ", 19200)}) {
    master.unit.set_master_baud(0);
    EXPECT_EQ(master.ask(command), "*\r\n");
    master.set({});
    power.power_cycle = true;
    master.set(power);
    master.wait(1.0);
    master.unit.set_master_baud(rate);
    EXPECT_EQ(master.ask("PX "), "* 49467\r\n");
  }
  EXPECT_EQ(master.ask("@A(9600,0,F) @B(9600,0,F) CHA CHB "), "*\r\n*\r\n*\r\n*\r\n");
}

TEST(PtuSetup, KeepsAndRestoresSettings) {
  Master master(ready_unit());
  EXPECT_EQ(master.ask("PS700 DS PS900 DR PS "), "*\r\n*\r\n*\r\n*\r\n* 700\r\n");
  EXPECT_EQ(master.ask("DF "), "*\r\n");
  EXPECT_EQ(master.ask("PS\r"), "PS\r\n* Target Pan speed is 1000 positions/sec\r\n");
}

TEST(PtuPresets, AreKeptAndRevisited) {
  Master master(ready_unit());
  master.ask("PP500 TP400 ", 5.0);
  EXPECT_EQ(master.ask("XS1 PP-300 TP0 A XG1 A PP TP ", 20.0),
            "*\r\n*\r\n*\r\n*\r\n*\r\n*\r\n* 500\r\n* 400\r\n");
  EXPECT_EQ(master.ask("XG2 XS33 XC1 XG1 "),
            "! Illegal argument\r\n! Illegal argument\r\n*\r\n! Illegal argument\r\n");
}

TEST(PtuPresets, AreUnknownToOldFirmware) {
  PtuUnitConfig config = ready_unit();
  config.firmware = "2.12.1d1";
  Master master(config);
  EXPECT_EQ(master.ask("XS1 "), "! Illegal Command Entered\r\n");
  EXPECT_EQ(master.ask("V "),
            "* Pan-Tilt Controller v2.12.1d1(C14/E), (C)2003 Directed Perception, Inc., "
            "All Rights Reserved\r\n");
}

TEST(PtuScan, SweepsUntilAnyByteComesAndGoesHomeThen) {
  Master master(ready_unit());
  master.ask("PS10000 TS10000 PA20000 TA20000 ", 1.0);
  EXPECT_EQ(master.ask("M-3000,2000,-500,400 ", 0.2), "*\r\n");
  double least = 0.0, greatest = 0.0, tilt_least = 0.0, tilt_greatest = 0.0;
  for (int i = 0; i < 1000; ++i) {
    EXPECT_EQ(master.wait(0.01), "");
    least = std::min(least, master.pan_counts());
    greatest = std::max(greatest, master.pan_counts());
    tilt_least = std::min(tilt_least, master.tilt_counts());
    tilt_greatest = std::max(tilt_greatest, master.tilt_counts());
  }
  EXPECT_NEAR(least, -3000.0, 150.0);
  EXPECT_NEAR(greatest, 2000.0, 150.0);
  EXPECT_NEAR(tilt_least, -500.0, 150.0);
  EXPECT_NEAR(tilt_greatest, 400.0, 150.0);
  EXPECT_EQ(master.ask("x", 3.0), "");
  EXPECT_DOUBLE_EQ(std::round(master.pan_counts()), 0.0);
  EXPECT_DOUBLE_EQ(std::round(master.tilt_counts()), 0.0);
}

TEST(PtuScan, TakesTheWholeTravelOrWhatItDidLast) {
  Master master(ready_unit());
  master.ask("PS18000 PA20000 ", 1.0);
  master.ask("M ", 3.5);
  EXPECT_LT(master.pan_counts(), -40000.0);
  master.ask(" ", 10.0);
  EXPECT_EQ(master.ask("M100,200 ", 1.0), "*\r\n");
  EXPECT_EQ(master.ask(" M ", 2.0), "*\r\n");
  EXPECT_NEAR(master.pan_counts(), 150.0, 51.0);
}

TEST(PtuScan, RefusesWhatIsNoScan) {
  Master master(ready_unit());
  EXPECT_EQ(master.ask("M1 "), "! Illegal argument\r\n");
  EXPECT_EQ(master.ask("M0,60000 "), "! Illegal argument\r\n");
  EXPECT_EQ(master.ask("MX "), "! Illegal Command Entered\r\n");
  EXPECT_EQ(master.ask("MS "), "! Illegal Command Entered\r\n");  // of the E-series
}

TEST(PtuScan, BeginsAtPowerUpWhenToldTo) {
  Master master(ready_unit());
  EXPECT_EQ(master.ask("MQ ME MQ "),
            "* Monitor at power up is DISABLED\r\n*\r\n* Monitor at power up is ENABLED\r\n");
  PtuFaults power;
  power.power_cycle = true;
  master.set(power);
  master.wait(5.0);
  EXPECT_LT(master.pan_counts(), -1000.0);
  master.ask(" MD ", 1.0);
  EXPECT_EQ(master.ask("MQ "), "* Monitor at power up is DISABLED\r\n");
}

TEST(PtuSlowSettings, TakeTheTimeThatIsConfigured) {
  PtuUnitConfig config = ready_unit();
  config.parameter_set_s = 6.0;
  Master master(config);
  EXPECT_EQ(master.ask("PL40 PL ", 5.5), "");
  EXPECT_EQ(master.wait(1.0), "*\r\n* 40\r\n");
}

}  // namespace
}  // namespace ols::sim
