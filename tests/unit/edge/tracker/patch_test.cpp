#include "edge/tracker/patch.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

namespace ols::tracker {
namespace {

TEST(Patch, SamplesPixelCentres) {
  cv::Mat ramp(60, 60, CV_8U);
  for (int row = 0; row < 60; ++row) {
    for (int column = 0; column < 60; ++column) {
      ramp.at<std::uint8_t>(row, column) = static_cast<std::uint8_t>(2 * column + row);
    }
  }
  // A box of 24x24 around (20, 30): its samples lie half a pixel off the centre.
  const Patch patch = sample_patch({ramp, {0, 0}, 1}, {20.0, 30.0}, {24.0, 24.0});
  EXPECT_NEAR(patch[0], 2 * (20 - 11.5) + (30 - 11.5), 1e-4);
  EXPECT_NEAR(patch[1] - patch[0], 2.0, 1e-4);
  EXPECT_NEAR(patch[kPatchSide] - patch[0], 1.0, 1e-4);
  // Reduced by two, the same place has the same grey value.
  const FrameView half = make_view(ramp, {10, 10, 40, 40}, 2);
  EXPECT_EQ(half.image.cols, 20);
  EXPECT_NEAR(bilinear(half.image, half.x_of(30.0), half.y_of(30.0)), 90.0, 1.0);
}

// Bright above the box, where its upper side is, and dark beside that.
TEST(Patch, TheLevelAroundABoxIsThatOfItsSides) {
  cv::Mat picture(100, 100, CV_8U, cv::Scalar(100));
  const double side = 20.0, reach = 0.72 * side;
  const int left = static_cast<int>(50.0 - reach);
  picture(cv::Rect(left, 0, 100 - left, 56)) = 200;
  EXPECT_EQ(level_around({picture, {0, 0}, 1}, {50.0, 50.0}, {side, side}), 200.0F);
}

TEST(Patch, IsBilinearWhereverAndHoweverLargeTheBox) {
  cv::Mat picture(90, 700, CV_8U);
  cv::RNG random(5);
  random.fill(picture, cv::RNG::UNIFORM, 0, 256);
  // Inside, over each border, wider than what is worked on at once, and of an image of few columns.
  const auto expect_bilinear = [](const FrameView& view, const Eigen::Vector2d& pixel,
                                  const Eigen::Vector2d& size_px) {
    const Patch patch = sample_patch(view, pixel, size_px);
    for (int i = 0; i < kPatchArea; ++i) {
      const double u = (i % kPatchSide + 0.5) / kPatchSide - 0.5;
      const double v = (i / kPatchSide + 0.5) / kPatchSide - 0.5;
      const float expected =
          bilinear(view.image, pixel.x() + u * size_px.x(), pixel.y() + v * size_px.y());
      ASSERT_NEAR(patch[static_cast<std::size_t>(i)], expected, 0.01) << i << " of " << size_px;
    }
  };
  const FrameView whole{picture, {0, 0}, 1};
  for (const double width : {3.0, 23.7, 60.0, 400.0, 650.0}) {
    for (const double x : {-5.0, 30.3, 350.6, 699.0}) {
      expect_bilinear(whole, {x, 40.2}, {width, 30.0});
      expect_bilinear(whole, {x, 88.0}, {width, 7.0});
    }
  }
  for (const int columns : {1, 2, 5, 8, 13}) {
    expect_bilinear({picture.colRange(0, columns), {0, 0}, 1}, {columns / 2.0, 20.0}, {9.0, 9.0});
  }
}

TEST(Template, IsEmptyWithoutStructureBeyondNoiseAndGradient) {
  cv::RNG random(6);
  for (const double contrast : {0.0, 12.0}) {
    cv::Mat sky(200, 200, CV_8U);
    for (int row = 0; row < 200; ++row) {
      for (int column = 0; column < 200; ++column) {
        const bool target = std::abs(row - 100) < 3 && std::abs(column - 100) < 4;
        sky.at<std::uint8_t>(row, column) = cv::saturate_cast<std::uint8_t>(
            80.0 + 0.5 * row + random.gaussian(1.5) - (target ? contrast : 0.0));
      }
    }
    const FrameView view{sky, {0, 0}, 1};
    EXPECT_NEAR(pixel_noise(sky), 1.5, 0.3);
    EXPECT_EQ(make_template(view, {100.0, 100.0}, {24.0, 18.0}).empty, contrast == 0.0);
  }
}

// Rough ground all over the picture is no noise that hides a target.
TEST(Template, IsNotEmptyOnRoughGround) {
  cv::RNG random(6);
  cv::Mat ground(200, 200, CV_8U);
  random.fill(ground, cv::RNG::NORMAL, 120.0, 25.0);
  ground(cv::Rect(96, 97, 8, 6)) = 20;
  EXPECT_FALSE(make_template({ground, {0, 0}, 1}, {100.0, 100.0}, {24.0, 18.0}).empty);
}

}  // namespace
}  // namespace ols::tracker
