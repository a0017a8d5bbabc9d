#include "edge/detector/overlay.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

namespace ols::detector {
namespace {

const cv::Size kSize(320, 240);
const cv::Rect kText(40, 20, 90, 16);
constexpr int kImages = 40;

Eigen::Matrix3d shift(double x_px) {
  Eigen::Matrix3d motion = Eigen::Matrix3d::Identity();
  motion(0, 2) = x_px;
  return motion;
}

// A piece of ground that begins `from` pixels to the right.
cv::Mat ground(double from) {
  static const cv::Mat all = [] {
    cv::Mat rough(kSize.height, 700, CV_32F);
    cv::RNG(11).fill(rough, cv::RNG::NORMAL, 0.0, 1.0);
    cv::GaussianBlur(rough, rough, cv::Size(0, 0), 2.5);
    cv::normalize(rough, rough, 60.0, 200.0, cv::NORM_MINMAX);
    rough.convertTo(rough, CV_8U);
    return rough;
  }();
  cv::Mat image;
  cv::warpAffine(all, image, cv::Matx23d(1, 0, -from, 0, 1, 0), kSize, cv::INTER_LINEAR);
  return image;
}

void write_text(cv::Mat& image) {
  cv::putText(image, "18.93 deg", kText.tl() + cv::Point(0, 14), cv::FONT_HERSHEY_SIMPLEX, 0.5,
              255.0, 2);
}

int marked(const Overlay& overlay, const cv::Rect& box) {
  return overlay.mask().empty() ? 0 : cv::countNonZero(overlay.mask()(box));
}

TEST(Overlay, IsWhatStaysWhileTheSceneMoves) {
  constexpr double kTurn_px = 2.0;  // an image
  Overlay overlay;
  for (int i = 0; i < kImages; ++i) {
    cv::Mat image = ground(kTurn_px * i);
    write_text(image);
    overlay.advance(image, shift(-kTurn_px), std::nullopt);
  }
  const int of_text = marked(overlay, kText);
  EXPECT_GT(of_text, 0.3 * kText.area());
  EXPECT_LT(marked(overlay, {{}, kSize}) - of_text, 0.01 * kSize.area());
  EXPECT_TRUE(overlay.covers({54.0, 28.0}, {8.0, 10.0}));
  EXPECT_FALSE(overlay.covers({60.0, 150.0}, {8.0, 12.0}));
  EXPECT_FALSE(overlay.covers({-60.0, 150.0}, {8.0, 12.0})) << "outside the image";
}

TEST(Overlay, IsAllThatStaysWhileTheMountTurns) {
  Overlay overlay;
  for (int i = 0; i < kImages; ++i) {
    cv::Mat image(kSize, CV_8U, cv::Scalar(120));
    write_text(image);
    overlay.advance(image, shift(0.0), shift(-2.0));
  }
  EXPECT_GT(marked(overlay, kText), 0.3 * kText.area());
}

TEST(Overlay, IsNotToldWhileTheCameraRests) {
  Overlay overlay;
  for (int i = 0; i < kImages; ++i) {
    cv::Mat image = ground(0.0);
    write_text(image);
    overlay.advance(image, shift(0.0), shift(0.0));
  }
  EXPECT_EQ(marked(overlay, {{}, kSize}), 0);
}

// The camera follows a target, which stays in the middle of the image for a while.
TEST(Overlay, ForgetsWhatLeaves) {
  constexpr double kTurn_px = 2.0;  // an image
  const cv::Rect middle(160, 120, 8, 8);
  Overlay overlay;
  const auto watch = [&](const cv::Point& off) {
    for (int i = 0; i < kImages; ++i) {
      cv::Mat image = ground(kTurn_px * i);
      cv::rectangle(image, middle + off, 255.0, cv::FILLED);
      overlay.advance(image, shift(-kTurn_px), std::nullopt);
    }
  };
  watch({0, 0});
  EXPECT_GT(marked(overlay, middle), 0);
  watch({30, 20});
  EXPECT_EQ(marked(overlay, middle), 0);
}

}  // namespace
}  // namespace ols::detector
