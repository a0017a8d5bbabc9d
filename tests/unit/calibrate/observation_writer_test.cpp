#include "tools/calibrate/observation_writer.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/unit/temporary_folder.h"
#include "tools/calibrate/observation_file.h"

namespace ols::calibration {
namespace {

// The reader is the measure.
TEST(ObservationWriter, WhatIsWrittenIsReadAgain) {
  Observation landmark;
  landmark.pose = 12;
  landmark.utime_us = 1'780'000'000'123'456;
  landmark.reading = {{1234.25, 0.0, -1}, {-77.0, 0.0, 1}};
  landmark.pixel = {640.125, 33.0625};
  landmark.sd_px = 0.21;
  landmark.reference = "spire \"old\"";
  Observation star = landmark;
  star.kind = Kind::kStar;
  star.reference.clear();
  Observation level;
  level.kind = Kind::kInclinometer;
  level.tilt_rad = {0.001, -0.002};
  level.tilt_sd_rad = 1e-5;
  level.zero_sd_rad = 2e-4;
  const TemporaryFolder folder;
  const std::string path = folder.path() + "/observations.jsonl";
  std::ofstream(path) << observation_lines({landmark, star, level}, "alfa");
  const auto read = read_observations(path, {"alfa"});
  ASSERT_EQ(read.size(), 3U);
  EXPECT_EQ(read[0].pose, landmark.pose);
  EXPECT_EQ(read[0].utime_us, landmark.utime_us);
  EXPECT_EQ(read[0].reading.pan.counts, 1234.25);
  EXPECT_EQ(read[0].reading.pan.approach, -1);
  EXPECT_EQ(read[0].pixel, landmark.pixel);
  EXPECT_EQ(read[0].sd_px, 0.21);
  EXPECT_EQ(read[0].reference, landmark.reference);
  EXPECT_EQ(read[1].kind, Kind::kStar);
  EXPECT_EQ(read[1].reference, "");
  EXPECT_NEAR(read[2].tilt_rad.y(), -0.002, 1e-12);
  EXPECT_NEAR(read[2].zero_sd_rad, 2e-4, 1e-12);
}

TEST(ObservationWriter, RectificationTargetsKeepWhatIsStatedOfThem) {
  Observation line;
  line.kind = Kind::kLevelLine;
  line.reference = "level line";
  line.sd_px = 0.1;
  line.pixel = {100.5, 240.0};
  line.target.second_px = {540.25, 243.5};
  line.target.sd = 1.5e-4;
  Observation cross = line, ruler = line;
  cross.kind = Kind::kCross;
  cross.target = {Eigen::Vector2d::Zero(), 25.5, 0.12, 0.002};
  ruler.kind = Kind::kRuler;
  ruler.target = {Eigen::Vector2d::Zero(), 40.0, -0.375, 0.0015};
  const TemporaryFolder folder;
  const std::string path = folder.path() + "/observations.jsonl";
  std::ofstream(path) << observation_lines({line, cross, ruler}, "alfa");
  const auto read = read_observations(path, {"alfa"});
  ASSERT_EQ(read.size(), 3U);
  EXPECT_EQ(read[0].target.second_px, line.target.second_px);
  EXPECT_NEAR(read[0].target.sd, 1.5e-4, 1e-12);
  EXPECT_EQ(read[1].kind, Kind::kCross);
  EXPECT_EQ(read[1].target.distance_m, 25.5);
  EXPECT_EQ(read[1].target.offset_m, 0.12);
  EXPECT_EQ(read[2].kind, Kind::kRuler);
  EXPECT_EQ(read[2].target.offset_m, -0.375);
  EXPECT_EQ(read[2].target.sd, 0.0015);
}

}  // namespace
}  // namespace ols::calibration
