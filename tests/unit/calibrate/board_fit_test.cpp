#include "tools/calibrate/board_fit.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <random>
#include <stdexcept>

namespace ols::calibration {
namespace {

const cv::Size kPicture(640, 480);

// Boards of 9 x 6 corners, tilted all around, with noise of a tenth of a pixel.
std::vector<BoardView> boards(std::uint32_t seed, int count = 12) {
  std::mt19937 random(seed);
  std::normal_distribution<float> noise(0.0F, 0.1F);
  const cv::Matx33d K(535.0, 0.0, 330.0, 0.0, 536.0, 236.0, 0.0, 0.0, 1.0);
  const cv::Vec<double, 5> distortion(-0.25, 0.05, 0.001, -0.0005, 0.02);
  std::vector<BoardView> views;
  for (int i = 0; i < count; ++i) {
    BoardView view;
    for (int k = 0; k < 54; ++k) {
      view.board.emplace_back(0.025F * static_cast<float>(k % 9),
                              0.025F * static_cast<float>(k / 9), 0.0F);
    }
    const cv::Vec3d turn(0.5 * std::sin(i), 0.5 * std::cos(1.7 * i), 0.2 * i);
    const cv::Vec3d shift(-0.1 + 0.01 * i, -0.06, 0.3 + 0.02 * i);
    cv::projectPoints(view.board, turn, shift, K, distortion, view.pixels);
    for (cv::Point2f& pixel : view.pixels) pixel += cv::Point2f(noise(random), noise(random));
    views.push_back(std::move(view));
  }
  return views;
}

// The told covariance is that of the errors: by the squares of 20 cameras, whitened.
TEST(BoardFit, ItsCovarianceIsThatOfItsErrors) {
  const BoardCamera::Vector truth{
      {535.0, 536.0 / 535.0, 330.0, 236.0, -0.25, 0.05, 0.001, -0.0005, 0.02}};
  constexpr int kCameras = 20;
  double squares = 0.0;
  for (int i = 0; i < kCameras; ++i) {
    const BoardCamera found = fit_boards(boards(100U + static_cast<std::uint32_t>(i)), kPicture);
    const BoardCamera::Vector off = found.values - truth;
    squares += off.dot(found.covariance.inverse() * off);
    EXPECT_NEAR(found.rms_px, 0.14, 0.02);
    EXPECT_EQ(found.view_rms_px.size(), 12U);
  }
  // Chi-square with 180 degrees of freedom: within four deviations.
  EXPECT_NEAR(squares, 9.0 * kCameras, 4.0 * std::sqrt(2.0 * 9.0 * kCameras));
}

TEST(BoardFit, FewBoardsAreRefused) {
  EXPECT_THROW(fit_boards(boards(1, 4), kPicture), std::invalid_argument);
}

}  // namespace
}  // namespace ols::calibration
