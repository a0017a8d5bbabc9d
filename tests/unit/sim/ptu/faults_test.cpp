#include "sim/ptu/faults.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "sim/ptu/reply_faults.h"
#include "tests/unit/sim/ptu/master.h"

namespace ols::sim {
namespace {

TEST(FaultyPtuUnit, HearsAndSaysNothingOnACutLine) {
  Master master(ready_unit());
  PtuFaults cut;
  cut.line_cut = true;
  master.set(cut);
  EXPECT_EQ(master.ask("PP5000 "), "");
  master.set({});
  EXPECT_EQ(master.wait(1.0), "");
  EXPECT_DOUBLE_EQ(master.pan_counts(), 0.0);
  EXPECT_EQ(master.ask("PP "), "* 0\r\n");
}

TEST(FaultyPtuUnit, SwitchesItsEchoOnOnce) {
  Master master(ready_unit());
  PtuFaults echo;
  echo.echo_on = true;
  master.set(echo);
  EXPECT_EQ(master.ask("PP "), "PP * 0\r\n");
  EXPECT_EQ(master.ask("ED "), "ED *\r\n");
  master.set(echo);  // no edge
  EXPECT_EQ(master.ask("PP "), "* 0\r\n");
}

TEST(FaultyPtuUnit, ForgetsWhatWasNotSavedWhenThePowerGoes) {
  PtuUnitConfig config = ready_unit();
  config.home_at_power_up = true;
  Master master(config);
  master.wait(40.0);
  master.ask("PS700 DS PS900 CV PS2000 ", 1.0);
  PtuFaults power;
  power.power_cycle = true;
  master.set(power);
  const std::string said = master.wait(0.5);
  EXPECT_EQ(said.rfind("\r\n### PAN-TILT CONTROLLER\r\n", 0), 0U) << said;
  EXPECT_EQ(master.ask("PP ", 60.0), "!T!T!P!P*\r\n* 0\r\n");
  EXPECT_EQ(master.ask("PS C "), "* 700\r\n* i\r\n");
}

TEST(FaultyPtuUnit, HomesWhenThePowerComesAsTheFaultSays) {
  for (const bool homes : {false, true}) {
    Master master(ready_unit());
    PtuFaults power;
    power.power_cycle = true;
    power.homes_then = homes;
    master.set(power);
    EXPECT_EQ(master.wait(60.0).find("!T!T!P!P*") != std::string::npos, homes);
  }
}

TEST(FaultyPtuUnit, DoesNotKnowWhereItStandsAfterwardsUnlessItHomes) {
  Master master(ready_unit());
  master.ask("PP8000 ", 10.0);
  PtuFaults power;
  power.power_cycle = true;
  master.set(power);
  EXPECT_NE(master.wait(0.5).find("PAN-TILT"), std::string::npos);
  EXPECT_EQ(master.ask("PP PR "), "* 0\r\n* 185.1428\r\n");  // its gears are not known either
  EXPECT_DOUBLE_EQ(std::round(master.pan_counts()), 8000.0);
  EXPECT_EQ(master.ask("R ", 60.0), "!T!T!P!P*\r\n");
  EXPECT_EQ(master.ask("PP PR "), "* 0\r\n* 11.5714\r\n");
  EXPECT_DOUBLE_EQ(std::round(master.pan_counts()), 0.0);
}

TEST(FaultyPtuUnit, DoesNotNoticeThatItSlips) {
  Master master(ready_unit());
  master.ask("PP5000 ", 2.0);  // on the way
  PtuFaults slip;
  slip.lost_steps_deg = -2.0;
  master.set(slip);
  master.wait(10.0);
  const double lost = std::round(2.0 * 3600.0 / 11.5714);
  EXPECT_EQ(master.ask("PP "), "* 5000\r\n");
  EXPECT_DOUBLE_EQ(std::round(master.pan_counts()), 5000.0 - lost);
  master.ask("PP100 ", 10.0);
  EXPECT_DOUBLE_EQ(std::round(master.pan_counts()), 100.0 - lost);
  master.ask("R ", 60.0);
  EXPECT_DOUBLE_EQ(std::round(master.pan_counts()), 0.0);
}

TEST(FaultyPtuUnit, TheWrongRateMakesNoise) {
  Master master(ready_unit());
  master.unit.set_master_baud(9600);
  EXPECT_EQ(master.ask("PP "), "* 0\r\n");
  EXPECT_EQ(master.ask("@(38400,0,F) "), "*\r\n");
  EXPECT_EQ(master.ask("PP ").find("* 0"), std::string::npos);
  master.unit.set_master_baud(38400);
  master.ask(" ");  // what it took for the begin of a command
  EXPECT_EQ(master.ask("PP "), "* 0\r\n");
}

const std::string kReply = "* -12345\r\n";

// The reply with its longest common begin and end with the right one cut off.
std::string left_over(std::string right, std::string heard) {
  while (!right.empty() && !heard.empty() && right.front() == heard.front()) {
    right.erase(0, 1);
    heard.erase(0, 1);
  }
  while (!right.empty() && !heard.empty() && right.back() == heard.back()) {
    right.pop_back();
    heard.pop_back();
  }
  return std::to_string(right.size()) + " for " + std::to_string(heard.size());
}

TEST(PtuReplyFaults, ChangesNothingUnlessAsked) {
  PtuReplyFaults faults(1);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(faults.pass(kReply, i), kReply);
}

TEST(PtuReplyFaults, GarblesOneByteOfAReply) {
  PtuReplyFaults faults(1);
  faults.set(1.0, 0.0, 0.0);
  std::set<std::string> kinds;
  for (int i = 0; i < 500; ++i) {
    const std::string heard = faults.pass(kReply, i);
    if (heard == kReply) continue;  // a lost byte may look like none beside an equal one
    kinds.insert(left_over(kReply, heard));
  }
  EXPECT_EQ(kinds, (std::set<std::string>{"1 for 1", "1 for 0", "0 for 1"}));
  EXPECT_EQ(faults.garbled(), 500U);
}

TEST(PtuReplyFaults, GarblesTheShareThatIsAskedFor) {
  PtuReplyFaults faults(2);
  faults.set(0.1, 0.0, 0.0);
  for (int i = 0; i < 5000; ++i) faults.pass("*\r\n", i);
  EXPECT_NEAR(static_cast<double>(faults.garbled()), 500.0, 70.0);
}

TEST(PtuReplyFaults, DoesNotDependOnThePiecesThatBytesComeIn) {
  PtuReplyFaults whole(3), pieces(3);
  whole.set(0.5, 3.0, 0.0);
  pieces.set(0.5, 3.0, 0.0);
  std::string heard;
  for (int i = 0; i < 100; ++i) {
    std::string one_by_one;
    for (const char byte : kReply) one_by_one += pieces.pass({&byte, 1}, i);
    heard = whole.pass(kReply, i);
    EXPECT_EQ(one_by_one, heard);
  }
}

TEST(PtuReplyFaults, LosesAReplyFromTimeToTime) {
  PtuReplyFaults faults(1);
  faults.set(0.0, 2.0, 10.0);
  std::string heard;
  for (int i = 0; i < 80; ++i) {
    heard += faults.pass("*\r\n", 10.0 + 0.1 * i).empty() ? std::to_string(i) + " " : "";
  }
  EXPECT_EQ(heard, "20 40 60 ");
  EXPECT_EQ(faults.lost(), 3U);
}

}  // namespace
}  // namespace ols::sim
