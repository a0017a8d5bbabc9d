#include "sim/ptu/presets.h"

#include <gtest/gtest.h>

#include "tests/unit/sim/ptu/master.h"

namespace ols::sim {
namespace {

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

}  // namespace
}  // namespace ols::sim
