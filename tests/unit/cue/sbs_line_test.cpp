#include "cue/sbs_line.h"

#include <gtest/gtest.h>

#include <string>

namespace ols {
namespace {

const std::string kLine =
    "MSG,3,1,1,4CA2D6,1,2026/05/28,20:26:40.123,2026/05/28,20:26:40.200,RYR81A  ,35000,430.5,"
    "271.0,49.25,-16.5,-640,,0,0,0,0";

TEST(SbsLine, HasTheCellsOfAMessage) {
  const SbsLine line(kLine);
  EXPECT_EQ(line.text(SbsLine::kType), "MSG");
  EXPECT_EQ(line.icao(), "4ca2d6");
  EXPECT_EQ(line.text(SbsLine::kDate), "2026/05/28");
  EXPECT_EQ(line.text(SbsLine::kTime), "20:26:40.123");
  EXPECT_EQ(line.text(SbsLine::kCallsign), "RYR81A  ");
  EXPECT_EQ(line.number(SbsLine::kHeightFt), 35000.0);
  EXPECT_EQ(line.number(SbsLine::kSpeedKt), 430.5);
  EXPECT_EQ(line.number(SbsLine::kTrackDeg), 271.0);
  EXPECT_EQ(line.number(SbsLine::kLatitudeDeg), 49.25);
  EXPECT_EQ(line.number(SbsLine::kLongitudeDeg), -16.5);
  EXPECT_EQ(line.number(SbsLine::kClimbFtMin), -640.0);
}

TEST(SbsLine, WhatIsMissingIsEmpty) {
  const SbsLine line("MSG,4,1,1,4CA2D6,,,,,,,,");
  EXPECT_EQ(line.text(SbsLine::kCallsign), "");
  EXPECT_FALSE(line.number(SbsLine::kHeightFt));
  EXPECT_FALSE(line.number(SbsLine::kClimbFtMin)) << "the line has ended";
  EXPECT_EQ(SbsLine("").text(SbsLine::kType), "");
  EXPECT_FALSE(SbsLine("MSG,3").icao());
}

TEST(SbsLine, RefusesWhatIsNoFiniteNumber) {
  for (const char* bad : {"nan", "inf", "-inf", "1e999", "12x", " 12", "0x10", "1;2"}) {
    const SbsLine line(std::string("MSG,3,1,1,4CA2D6,1,,,,,,").append(bad));
    EXPECT_FALSE(line.number(SbsLine::kHeightFt)) << bad;
  }
}

TEST(SbsLine, AnAddressHasSixHexadecimalDigits) {
  for (const char* bad : {"", "4CA2D", "4CA2D67", "4CA2DG", "~CA2D6"}) {
    EXPECT_FALSE(SbsLine(std::string("MSG,3,1,1,").append(bad).append(",1")).icao()) << bad;
  }
}

}  // namespace
}  // namespace ols
