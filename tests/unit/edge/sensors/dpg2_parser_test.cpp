#include "edge/sensors/dpg2/dpg2_parser.h"

#include <gtest/gtest.h>

#include <random>

#include "geometry/angles.h"

namespace ols::sensors {
namespace {

constexpr double kRange_rad = 0.7;
constexpr const char* kPair = "X=+00.430\r\nY=-00.084\r\n";  // as in the manual

std::vector<AxisAngles> parse(std::string_view bytes, Dpg2Counters* counters = nullptr) {
  Dpg2Parser parser(kRange_rad);
  const auto out = parser.receive(bytes, 1.0);
  if (counters != nullptr) *counters = parser.counters();
  return out;
}

TEST(Dpg2, ReadsAPairAsTheManualShowsIt) {
  const auto out = parse(kPair);
  ASSERT_EQ(out.size(), 1U);
  EXPECT_NEAR(degrees(out[0].x_rad), 0.430, 1e-12);
  EXPECT_NEAR(degrees(out[0].y_rad), -0.084, 1e-12);
  EXPECT_EQ(out[0].time_s, 1.0);
}

TEST(Dpg2, AnySplitOfTheBytesGivesTheSame) {
  const std::string stream = std::string("084\r\n") + kPair + "X=+00.4\x80" + "0\r\nY=-00.084\r\n" +
                             "X=-01.000\rY=+12.345\n" + std::string(200, 'z') + "\r\n" + kPair;
  Dpg2Counters whole_counters;
  const auto whole = parse(stream, &whole_counters);
  ASSERT_EQ(whole.size(), 3U);
  std::mt19937 random(7);
  for (int round = 0; round < 200; ++round) {
    Dpg2Parser parser(kRange_rad);
    std::vector<AxisAngles> pieces;
    for (std::size_t at = 0; at < stream.size();) {
      const std::size_t n = 1 + random() % 9;
      for (const auto& pair : parser.receive(std::string_view(stream).substr(at, n), 1.0)) {
        pieces.push_back(pair);
      }
      at += n;
    }
    ASSERT_EQ(pieces.size(), whole.size());
    for (std::size_t i = 0; i < whole.size(); ++i) {
      EXPECT_EQ(pieces[i].x_rad, whole[i].x_rad);
      EXPECT_EQ(pieces[i].y_rad, whole[i].y_rad);
    }
    EXPECT_EQ(parser.counters().garbled, whole_counters.garbled);
    EXPECT_EQ(parser.counters().unpaired, whole_counters.unpaired);
  }
}

// There is no checksum: a line is a reading only in its exact form.
TEST(Dpg2, ALineThatIsNotExactlyAReadingIsGarbled) {
  for (const char* line :
       {"X=+0.430", "X=+000.430", "X=00.430", "X=+00.43", "X=+00,430", "X=+00.4300", "X+00.430",
        "X=+00.43o", "XX=+00.430", "Z=+00.430", "X= 00.430", "X=+00.430Y=-00.084", "=", "X="}) {
    Dpg2Counters counters;
    EXPECT_TRUE(parse(std::string(line) + "\r\nY=-00.084\r\n", &counters).empty()) << line;
    EXPECT_EQ(counters.garbled, 1U) << line;
    EXPECT_EQ(counters.unpaired, 1U) << line;
  }
}

TEST(Dpg2, OnlyAnXAndTheYRightAfterItAreAPair) {
  Dpg2Counters counters;
  EXPECT_TRUE(parse("X=+00.430\r\nX=+00.430\r\n", &counters).empty());
  EXPECT_EQ(counters.unpaired, 1U);
  EXPECT_TRUE(parse("Y=+00.430\r\n", &counters).empty());
  EXPECT_EQ(counters.unpaired, 1U);
  EXPECT_TRUE(parse("X=+00.430\r\n#!\r\nY=+00.430\r\n", &counters).empty());
  EXPECT_EQ(counters.unpaired, 2U);
}

TEST(Dpg2, AnXAndAYOfDifferentMomentsAreNoPair) {
  Dpg2Parser parser(kRange_rad);
  EXPECT_TRUE(parser.receive("X=+00.430\r\n", 1.0).empty());
  EXPECT_TRUE(parser.receive("Y=-00.084\r\n", 6.0).empty());  // the line was cut between them
  EXPECT_EQ(parser.counters().unpaired, 1U);
  EXPECT_EQ(parser.receive(kPair, 6.1).size(), 1U);
}

TEST(Dpg2, WhatIsOutOfRangeIsRefused) {
  Dpg2Counters counters;
  EXPECT_TRUE(parse("X=+60.000\r\nY=-00.084\r\n", &counters).empty());
  EXPECT_EQ(counters.out_of_range, 1U);
  EXPECT_TRUE(parse("X=+00.000\r\nY=-60.000\r\n", &counters).empty());
  EXPECT_EQ(counters.out_of_range, 1U);
}

TEST(Dpg2, TakesTheVersionOnlyWhenItWasAskedFor) {
  Dpg2Parser parser(kRange_rad);
  parser.receive("DPG2 V1.4\r\n", 1.0);
  EXPECT_EQ(parser.counters().garbled, 1U);
  parser.expect_version();
  EXPECT_EQ(parser.receive("X=+00.430\r\nDPG2 V1.4\r\nY=-00.084\r\n", 1.0).size(), 1U);
  EXPECT_EQ(parser.version(), "DPG2 V1.4");
  EXPECT_EQ(parser.counters().garbled, 1U);
  parser.expect_version();
  parser.receive("X=+00.43\r\n", 1.0);  // a broken reading is not a version
  EXPECT_EQ(parser.version(), "DPG2 V1.4");
}

}  // namespace
}  // namespace ols::sensors
