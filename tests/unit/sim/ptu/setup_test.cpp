#include "sim/ptu/setup.h"

#include <gtest/gtest.h>

#include <cmath>

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

}  // namespace
}  // namespace ols::sim
