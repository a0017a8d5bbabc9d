#include "calibration/pictures/mirrored_blend.h"

#include <gtest/gtest.h>

#include "tests/unit/calibration/target_scene.h"

namespace ols::calibration {
namespace {

using test::Board;

// Contrast of the lines in the middle column against those at the edge of the picture.
double broken(double roll_rad) {
  Board board{.middle = {0.0, 30.0, 0.0}, .gray = test::lines_on(4.0, 3.0, 0.4, 0.06)};
  const cv::Mat gray = test::picture_of(test::half_size_camera(), test::looking_north(roll_rad),
                                        {board}, {.noise_gray = 0.0, .uneven = 0.0});
  const cv::Mat blend = mirrored_blend(gray);
  cv::Mat middle, edge;
  blend.col(320).convertTo(middle, CV_32F);
  blend.col(30).convertTo(edge, CV_32F);
  cv::Scalar mean, sd_middle, sd_edge;
  cv::meanStdDev(middle, mean, sd_middle);
  cv::meanStdDev(edge, mean, sd_edge);
  return sd_edge[0] / sd_middle[0];
}

TEST(MirroredBlend, IsItsOwnMirrorImage) {
  cv::Mat gray(5, 8, CV_8U);
  cv::randu(gray, 0, 255);
  const cv::Mat blend = mirrored_blend(gray);
  cv::Mat mirrored;
  cv::flip(blend, mirrored, 1);
  EXPECT_EQ(cv::norm(blend, mirrored, cv::NORM_INF), 0.0);
  EXPECT_NEAR(blend.at<std::uint8_t>(2, 1),
              0.5 * (gray.at<std::uint8_t>(2, 1) + gray.at<std::uint8_t>(2, 6)), 0.51);
}

// Rolled by half a line's width at the edge, every line stands there twice and half as dark.
TEST(MirroredBlend, LevelLinesRunThroughAndLeaningOnesBreak) {
  EXPECT_GT(broken(0.0), 0.95);
  EXPECT_LT(broken(0.04), 0.8);
}

}  // namespace
}  // namespace ols::calibration
