#include "edge/detector/line_sum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <random>

#include "edge/detector/binned_residual.h"

namespace ols::detector {
namespace {

const cv::Size kSize(320, 240);
constexpr double kNoise = 2.0;  // [grey levels]

// Images of a noisy sky, onto which `draw` draws; 0 is the oldest.
ResidualPast past_of(const std::function<void(int, cv::Mat&)>& draw,
                     const Eigen::Matrix3d& motion = Eigen::Matrix3d::Identity()) {
  ResidualPast past;
  BinnedResidual residual;
  cv::RNG random(6);
  for (int i = 0; i < static_cast<int>(ResidualPast::kImages); ++i) {
    cv::Mat picture(kSize, CV_32F), gray;
    random.fill(picture, cv::RNG::NORMAL, 120.3, kNoise);
    draw(i, picture);
    picture.convertTo(gray, CV_8U);
    past.add(residual.measure(gray), motion);
  }
  return past;
}

void add(cv::Mat& picture, int x, int y, double levels) {
  cv::Mat part = picture(cv::Rect(x, y, 2, 2));
  cv::add(part, cv::Scalar(levels), part);
}

TEST(BinnedResidual, IsAMatchedFilterOnHalfThePixels) {
  cv::Mat gray(60, 80, CV_8U, cv::Scalar(100));
  gray(cv::Rect(40, 20, 2, 2)).setTo(164);
  const cv::Mat residual = BinnedResidual().measure(gray);
  ASSERT_EQ(residual.size(), cv::Size(40, 30));
  double highest = 0.0;
  cv::Point peak;
  cv::minMaxLoc(residual, nullptr, &highest, nullptr, &peak);
  EXPECT_EQ(peak, cv::Point(20, 10));
  // Nine sixteenths of the light, less what is in the mean of 81 bins.
  EXPECT_NEAR(highest, 64.0 * BinnedResidual::kUnits * (9.0 / 16.0 - 1.0 / 81.0), 2.0);
  EXPECT_EQ(residual.at<std::int16_t>(25, 35), 0);
}

TEST(BinnedResidual, HasTheStatedNoise) {
  cv::Mat gray(240, 320, CV_8U);
  cv::RNG(3).fill(gray, cv::RNG::NORMAL, 120.0, 8.0);
  cv::Scalar mean, sd;
  cv::meanStdDev(BinnedResidual().measure(gray), mean, sd);
  EXPECT_NEAR(sd[0], 8.0 * BinnedResidual::kUnitsOfNoise,
              0.05 * 8.0 * BinnedResidual::kUnitsOfNoise);
}

TEST(LineSum, HasAStandardDeviationOfOneInNoise) {
  const ResidualPast past = past_of([](int, cv::Mat&) {});
  std::mt19937 random(1);
  std::uniform_real_distribution<double> x(60.0, 260.0), y(60.0, 180.0), v(-3.0, 3.0);
  double plain = 0.0, without = 0.0;
  constexpr int kLines = 1500;
  for (int i = 0; i < kLines; ++i) {
    const Eigen::Vector2d pixel(x(random), y(random)), velocity(v(random), v(random));
    const LineSum line(past, pixel);
    plain += std::pow(line.along(pixel, velocity, 8), 2);
    without += std::pow(line.along_without_scene(pixel, velocity, 8), 2);
  }
  EXPECT_NEAR(std::sqrt(plain / kLines), 1.0, 0.12);
  EXPECT_NEAR(std::sqrt(without / kLines), 1.0, 0.12);
}

TEST(LineSum, AddsUpWhatMovesAndNotWhatIsStill) {
  const ResidualPast past = past_of([](int i, cv::Mat& picture) {
    add(picture, 100 + 2 * i, 100 - i, 8.0);
    add(picture, 200, 150, 8.0);
  });
  const Eigen::Vector2d mover(130.5, 85.5), velocity(2.0, -1.0), still(200.5, 150.5),
      none(0.0, 0.0);
  const LineSum along(past, mover), at_rest(past, still);
  EXPECT_GT(along.along(mover, velocity, 16), 15.0);
  EXPECT_GT(along.along_without_scene(mover, velocity, 16), 13.0);
  EXPECT_LT(along.along(mover, -velocity, 16), 6.0);
  EXPECT_GT(at_rest.along(still, none, 16), 15.0);
  EXPECT_LT(std::abs(at_rest.along_without_scene(still, none, 16)), 3.0);
}

TEST(LineSum, AmongTextureThatMovesAlongAPointCountsLess) {
  cv::Mat texture(kSize.height, 2 * kSize.width, CV_32F);
  cv::RNG(9).fill(texture, cv::RNG::NORMAL, 0.0, 5.0);
  cv::GaussianBlur(texture, texture, cv::Size(0, 0), 1.5);
  const Eigen::Vector2d velocity(2.0, 0.0);
  const auto sums = [&](const cv::Point& begin, double texture_levels) {
    const ResidualPast past = past_of([&](int i, cv::Mat& picture) {
      cv::scaleAdd(texture(cv::Rect({kSize.width / 2 - 2 * i, 0}, kSize)), texture_levels, picture,
                   picture);
      add(picture, begin.x + 2 * i, begin.y, 8.0);
    });
    const Eigen::Vector2d newest(begin.x + 30.5, begin.y + 0.5);
    const LineSum line(past, newest);
    return Eigen::Vector2d(line.along_without_scene(newest, velocity, 16),
                           line.along_without_texture(newest, velocity, 16));
  };
  for (const cv::Point begin : {cv::Point(130, 100), cv::Point(276, 10)}) {
    const Eigen::Vector2d alone = sums(begin, 0.0), among = sums(begin, 1.0);
    EXPECT_GT(alone.y(), 0.7 * alone.x()) << begin;
    EXPECT_GT(among.x(), 10.0) << begin;
    EXPECT_LT(3.0 * among.y(), among.x()) << begin;
  }
}

TEST(LineSum, OneImageCountsLittle) {
  const ResidualPast past = past_of([](int i, cv::Mat& picture) {
    if (i == 12) add(picture, 100, 100, 100.0);
  });
  const LineSum line(past, {100.5, 100.5});
  EXPECT_LT(line.along({100.5, 100.5}, {0.0, 0.0}, 8), 4.0);
}

TEST(LineSum, FollowsTheScene) {
  Eigen::Matrix3d motion = Eigen::Matrix3d::Identity();
  motion(0, 2) = 3.0;  // [px per image]
  const ResidualPast past =
      past_of([](int i, cv::Mat& picture) { add(picture, 100 + 4 * i, 100, 8.0); }, motion);
  const Eigen::Vector2d pixel(160.5, 100.5);
  EXPECT_GT(LineSum(past, pixel).along(pixel, {1.0, 0.0}, 16), 15.0);
}

TEST(LineSum, IsNothingOutsideTheImage) {
  const ResidualPast past = past_of([](int, cv::Mat&) {});
  const Eigen::Vector2d outside(-20.0, 100.0);
  EXPECT_EQ(LineSum(past, outside).along(outside, {1.0, 0.0}, 16), 0.0);
}

}  // namespace
}  // namespace ols::detector
