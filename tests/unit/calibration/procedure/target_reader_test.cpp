#include "calibration/procedure/target_reader.h"

#include <gtest/gtest.h>

#include "tests/unit/calibration/procedure/target_station.h"

namespace ols::calibration {
namespace {

using test::TargetStation;

constexpr CrossBoard kCross{.distance_m = 30.0, .apart_m = 0.8};
constexpr RulerPair kRulers{.near_m = 20.0, .far_m = 40.0};

TEST(TargetReader, TheLevelLineIsShownInTheMirroredBlendWithItsRoll) {
  TargetStation station(3, sim::UnitErrors::kNone);
  const Taken picture = station.shoot({}, {station.level_board(radians(0.5))}, {});
  const TargetReading reading = level_line_reader({})->read(picture, {});
  EXPECT_EQ(reading.trouble, "");
  // The board leans to the left, as if the camera were rolled to the right.
  EXPECT_NE(reading.number.find("rolled by +0.5"), std::string::npos) << reading.number;
  cv::Mat mirrored;
  cv::flip(reading.shown, mirrored, 1);
  EXPECT_EQ(cv::norm(reading.shown, mirrored, cv::NORM_INF), 0.0);
  ASSERT_GE(reading.observations.size(), 6U);
  EXPECT_EQ(reading.observations[0].kind, Kind::kLevelLine);
  EXPECT_EQ(reading.observations[0].pose, picture.pose);
}

TEST(TargetReader, TheRightCrossIsPlacedAndAWrongDistanceNamed) {
  TargetStation station(4, sim::UnitErrors::kNone);
  const Taken picture = station.shoot({}, {station.cross_board(kCross, 0.0, {})}, {});
  const TargetReading reading = cross_reader(station.model(), kCross)->read(picture, {});
  EXPECT_EQ(reading.trouble, "");
  ASSERT_EQ(reading.observations.size(), 1U);
  EXPECT_EQ(reading.observations[0].target.offset_m, 0.8);
  EXPECT_NEAR(reading.crosshair_px->x(), 319.5 + 0.8 / 29.95 * 6666.7, 0.3);
  CrossBoard wrong = kCross;
  wrong.distance_m = 22.0;
  const TargetReading far = cross_reader(station.model(), wrong)->read(picture, {});
  EXPECT_TRUE(far.observations.empty());
  EXPECT_NE(far.trouble.find("m, not at 22.0"), std::string::npos) << far.trouble;
}

TEST(TargetReader, BothRulersAreReadInTheMiddleRow) {
  TargetStation station(5, sim::UnitErrors::kNone);
  const Taken picture = station.shoot({}, station.rulers(kRulers, 0.0), {});
  const TargetReading reading = ruler_reader(station.model(), kRulers)->read(picture, {});
  EXPECT_EQ(reading.trouble, "");
  ASSERT_EQ(reading.observations.size(), 2U);
  // Zeros 4 cm over the camera, as far as the tripod is level; both readings alike.
  EXPECT_EQ(reading.observations[0].reference, "nearer");
  EXPECT_LT(reading.observations[0].target.offset_m, 0.0);
  EXPECT_EQ(reading.observations[1].target.distance_m, 40.0);
}

TEST(TargetReader, ARulerAtAnotherDistanceThanStatedIsNamed) {
  TargetStation station(6, sim::UnitErrors::kNone);
  const Taken picture = station.shoot({}, station.rulers(kRulers, 0.0), {});
  const RulerPair exchanged{.near_m = 20.0, .far_m = 26.0};
  const TargetReading reading =
      ruler_reader(station.model(), exchanged)->read(picture, Eigen::Vector2d(419.5, 230.0));
  EXPECT_TRUE(reading.observations.empty());
  EXPECT_NE(reading.trouble.find("the farther ruler"), std::string::npos) << reading.trouble;
}

TEST(TargetReader, OnlyTargetsThatArePutUpHaveAReader) {
  RectificationTargets targets;
  targets.level.emplace();
  targets.rulers = kRulers;
  const auto readers = target_readers({}, targets);
  ASSERT_EQ(readers.size(), 2U);
  EXPECT_EQ(readers[0]->name(), "level line");
  EXPECT_EQ(readers[1]->name(), "rulers");
}

}  // namespace
}  // namespace ols::calibration
