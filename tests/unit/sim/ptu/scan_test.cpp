#include "sim/ptu/scan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/sim/ptu/master.h"

namespace ols::sim {
namespace {

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

}  // namespace
}  // namespace ols::sim
