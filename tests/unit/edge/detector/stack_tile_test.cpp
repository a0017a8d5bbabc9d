#include "edge/detector/stack_tile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "edge/detector/binned_residual.h"

namespace ols::detector {
namespace {

const cv::Size kBins(160, 120);
const cv::Point kCorner(40, 40);

// A past of white noise in the residual, onto which `more` is added.
struct Sample {
  explicit Sample(double noise, const cv::Mat& more = cv::Mat(), bool moves = false) {
    cv::RNG random(4);
    for (std::size_t i = 0; i < ResidualPast::kImages; ++i) {
      cv::Mat residual(kBins, CV_16S);
      random.fill(residual, cv::RNG::NORMAL, 0.0, noise);
      if (!more.empty()) {
        const int shift = moves ? static_cast<int>(3 * i) : 0;
        cv::add(residual, more(cv::Rect({shift, 0}, kBins)), residual);
      }
      past.add(residual, Eigen::Matrix3d::Identity());
    }
    even = tile->prepare(past, kCorner, *stack);
  }
  ResidualPast past;
  std::unique_ptr<StackTile> tile = std::make_unique<StackTile>();
  std::unique_ptr<VelocityStack> stack = std::make_unique<VelocityStack>();
  bool even = false;
};

cv::Mat texture(double sd) {
  cv::Mat image(kBins.height, kBins.width + 100, CV_16S);
  cv::RNG(8).fill(image, cv::RNG::NORMAL, 0.0, sd);
  return image;
}

double sd_of(const VelocityStack::Values& values) {
  double squares = 0.0;
  for (const auto value : values) squares += std::pow(value - VelocityStack::kZero, 2);
  return std::sqrt(squares / static_cast<double>(values.size()));
}

TEST(StackTile, ScalesByTheNoise) {
  for (const double noise : {20.0, 60.0}) {
    Sample sample(noise);
    ASSERT_TRUE(sample.even);
    EXPECT_NEAR(sd_of(sample.stack->image(3)), 1.15 * StackTile::kScale, 0.1 * StackTile::kScale);
  }
}

TEST(StackTile, RemovesWhatStaysStill) {
  Sample sample(40.0, texture(20.0));
  ASSERT_TRUE(sample.even);
  EXPECT_NEAR(sd_of(sample.stack->image(3)), 1.15 * StackTile::kScale, 0.1 * StackTile::kScale);
}

TEST(StackTile, RefusesTexture) { EXPECT_FALSE(Sample(40.0, texture(60.0)).even); }

TEST(StackTile, RefusesNoiseThatHidesInTheRounding) {
  EXPECT_FALSE(Sample(0.3 * BinnedResidual::kUnitsOfNoise).even);
}

TEST(StackTile, RefusesSomethingLargeThatMoves) {
  cv::Mat edge = cv::Mat::zeros(kBins.height, kBins.width + 100, CV_16S);
  for (int x = 0; x < edge.cols; x += 40) edge(cv::Rect(x, 0, 5, edge.rows)).setTo(800);
  EXPECT_FALSE(Sample(40.0, edge, true).even);
}

TEST(StackTile, FollowsTheScene) {
  ResidualPast past;
  Eigen::Matrix3d motion = Eigen::Matrix3d::Identity();
  motion(0, 2) = 4.0;  // [px]: two bins per image
  const cv::Mat all = texture(70.0);
  cv::RNG random(4);
  for (int i = 0; i < 16; ++i) {
    cv::Mat residual(kBins, CV_16S);
    random.fill(residual, cv::RNG::NORMAL, 0.0, 120.0);
    cv::add(residual, all(cv::Rect({60 - 2 * i, 0}, kBins)), residual);
    past.add(residual, motion);
  }
  const auto tile = std::make_unique<StackTile>();
  const auto stack = std::make_unique<VelocityStack>();
  ASSERT_TRUE(tile->prepare(past, kCorner, *stack));
  EXPECT_NEAR(sd_of(stack->image(5)), 1.15 * StackTile::kScale, 0.1 * StackTile::kScale);
}

}  // namespace
}  // namespace ols::detector
