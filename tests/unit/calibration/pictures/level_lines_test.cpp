#include "calibration/pictures/level_lines.h"

#include <gtest/gtest.h>

#include "geometry/angles.h"
#include "tests/unit/calibration/target_scene.h"

namespace ols::calibration {
namespace {

using test::Board;
using test::Conditions;

constexpr double kArcsec = kPi / 648000.0;

cv::Mat picture(double roll_rad, const Conditions& conditions = {}) {
  const Board board{.middle = {0.0, 30.0, 0.1}, .gray = test::lines_on(4.0, 3.0, 0.5, 0.04)};
  return test::picture_of(test::half_size_camera(), test::looking_north(roll_rad), {board},
                          conditions);
}

// A camera that is rolled clockwise sees the lines rise to the right.
double off_arcsec(double roll_rad, const Conditions& conditions) {
  const LevelLines lines = find_level_lines(picture(roll_rad, conditions));
  EXPECT_TRUE(lines) << to_string(lines.refusal);
  return (std::atan(lines.slope) + roll_rad) / kArcsec;
}

TEST(LevelLines, TellTheRollThroughNoiseBlurAndUnevenLight) {
  double squares = 0.0;
  int count = 0;
  for (const double roll_deg : {-3.0, -0.4, 0.0, 0.13, 1.7}) {
    for (const double blur_px : {0.6, 3.0, 8.0}) {
      Conditions conditions{.blur_px = blur_px, .noise_gray = 4.0, .uneven = 0.5};
      conditions.seed = static_cast<unsigned>(++count);
      squares += std::pow(off_arcsec(radians(roll_deg), conditions), 2);
    }
  }
  const double rms = std::sqrt(squares / count);
  std::printf("level lines: %.1f arc seconds RMS\n", rms);
  EXPECT_LT(rms, 15.0);
}

TEST(LevelLines, EachEdgeIsAsGoodAsItSays) {
  double squares = 0.0;
  int count = 0;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    const LevelLines lines = find_level_lines(picture(0.01, {.noise_gray = 6.0, .seed = seed}));
    ASSERT_TRUE(lines);
    ASSERT_GE(lines.edges.size(), 6U);
    for (const LevelEdge& edge : lines.edges) {
      const Eigen::Vector2d along = edge.right_px - edge.left_px;
      EXPECT_GT(along.x(), 200.0);
      const double off_px = along.y() + std::tan(0.01) * along.x();
      squares += off_px * off_px / (2.0 * edge.sd_px * edge.sd_px);
      ++count;
    }
  }
  // A drawn edge has stairs, which are no noise: it says more than it is off by.
  EXPECT_GT(std::sqrt(squares / count), 0.1);
  EXPECT_LT(std::sqrt(squares / count), 1.3);
}

TEST(LevelLines, AreSeenBesideWhatHidesThem) {
  const Conditions hidden{.hidden = {{120, 0, 90, 480}, {400, 200, 160, 100}}};
  EXPECT_LT(std::abs(off_arcsec(0.006, hidden)), 20.0);
}

TEST(LevelLines, AreRefusedWithWords) {
  EXPECT_EQ(find_level_lines(cv::Mat(480, 640, CV_8U, cv::Scalar(90))).refusal,
            LevelLines::Refusal::kNothing);
  EXPECT_EQ(find_level_lines(picture(radians(11.0))).refusal, LevelLines::Refusal::kSteep);
  EXPECT_EQ(find_level_lines(picture(0.0, {.hidden = {{0, 0, 540, 480}}})).refusal,
            LevelLines::Refusal::kShort);
  Board far{.middle = {0.0, 30.0, 0.0}, .gray = test::lines_on(4.0, 3.0, 1.2, 0.4)};
  const cv::Mat blurred =
      test::picture_of(test::half_size_camera(), test::looking_north(), {far}, {.blur_px = 30.0});
  EXPECT_EQ(find_level_lines(blurred).refusal, LevelLines::Refusal::kBlurred);
  EXPECT_NE(std::string(to_string(LevelLines::Refusal::kSteep)).find("8 degrees"),
            std::string::npos);
}

}  // namespace
}  // namespace ols::calibration
