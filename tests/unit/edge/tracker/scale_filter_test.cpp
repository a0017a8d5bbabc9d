#include "edge/tracker/scale_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace ols::tracker {
namespace {

constexpr double kInterval_s = 1.0 / 30.0;
const Eigen::Vector2d kAt(160.3, 119.6);
const Eigen::Vector2d kSize(40.0, 30.0);

cv::Mat noise_of(const cv::Size& size, std::uint64_t seed, double smooth, double sd) {
  cv::RNG random(seed);
  cv::Mat made(size, CV_32F);
  random.fill(made, cv::RNG::NORMAL, 0.0, 1.0);
  cv::GaussianBlur(made, made, {0, 0}, smooth);
  cv::Scalar mean, deviation;
  cv::meanStdDev(made, mean, deviation);
  return made * (sd / deviation[0]) + 120.0;
}

// A textured target, `size` times kSize large, before a texture that keeps its size.
cv::Mat picture(double size, double turned = 0.0) {
  static const cv::Mat behind = noise_of({320, 240}, 3, 2.5, 20.0);
  static const cv::Mat target = noise_of({80, 60}, 5, 4.0, 40.0);
  const double scale = 0.5 * size;  // the texture has two pixels for one
  const double c = scale * std::cos(turned), s = scale * std::sin(turned);
  const cv::Matx23d map(c, -s, kAt.x() - c * 39.5 + s * 29.5, s, c, kAt.y() - s * 39.5 - c * 29.5);
  cv::Mat image = behind.clone();
  cv::warpAffine(target, image, map, image.size(), cv::INTER_AREA, cv::BORDER_TRANSPARENT);
  cv::Mat gray;
  image.convertTo(gray, CV_8U);
  return gray;
}

// One look says too little, by up to 0.6 of a step from one size to the next: only seventeen sizes
// are looked at, and what looks much the same at all of them pulls the answer to no growth. A
// second look, with the box grown by the first answer, says most of what is missing.
TEST(ScaleFilter, MeasuresGrowth) {
  const double one_look = 0.6 * std::log(ScaleFilter::kStep), two_looks = 0.01;
  ScaleFilter filter;
  filter.learn(*ScaleFilter::look_at(picture(1.0), kAt, kSize), 0.0, kInterval_s);
  for (const double size : {0.93, 0.97, 1.0, 1.02, 1.07}) {
    const auto seen = ScaleFilter::look_at(picture(size), kAt, kSize);
    ASSERT_TRUE(seen);
    const double growth = filter.growth(*seen);
    EXPECT_NEAR(growth, std::log(size), one_look) << size;
    const auto again = ScaleFilter::look_at(picture(size), kAt, std::exp(growth) * kSize);
    ASSERT_TRUE(again);
    EXPECT_NEAR(growth + filter.growth(*again), std::log(size), two_looks) << size;
  }
}

// Nothing of the first image is left in the end: it is twice as large, and has turned.
TEST(ScaleFilter, FollowsATargetThatGrowsAndTurns) {
  ScaleFilter filter;
  double followed = 1.0, size = 1.0;
  for (int k = 0; k < 100; ++k, size *= std::pow(2.0, 0.01)) {
    const auto seen = ScaleFilter::look_at(picture(size, 0.005 * k), kAt, followed * kSize);
    ASSERT_TRUE(seen);
    const double growth = filter.growth(*seen);
    filter.learn(*seen, growth, kInterval_s);
    followed *= std::exp(growth);
  }
  EXPECT_NEAR(followed / size, 1.0, 0.15);
}

TEST(ScaleFilter, KeepsTheSizeOfATargetThatDoesNotGrow) {
  ScaleFilter filter;
  double followed = 1.0;
  for (int k = 0; k < 100; ++k) {
    const auto seen = ScaleFilter::look_at(picture(1.0, 0.01 * k), kAt, followed * kSize);
    const double growth = filter.growth(*seen);
    filter.learn(*seen, growth, kInterval_s);
    followed *= std::exp(growth);
  }
  EXPECT_NEAR(followed, 1.0, 0.05);
}

TEST(ScaleFilter, KnowsNoGrowthBeforeItHasLearnt) {
  EXPECT_EQ(ScaleFilter().growth(*ScaleFilter::look_at(picture(1.1), kAt, kSize)), 0.0);
}

TEST(ScaleFilter, HasNothingToSayOnAFewPixels) {
  EXPECT_FALSE(ScaleFilter::look_at(picture(1.0), kAt, {9.0, 9.0}));
}

TEST(ScaleFilter, HasNothingToSayOnABoxWithAnEmptyBorder) {
  EXPECT_TRUE(ScaleFilter::look_at(picture(1.0), kAt, kSize));
  cv::Mat sky(240, 320, CV_8U, cv::Scalar(120));
  const cv::Rect inner(150, 112, 20, 15);
  picture(1.0)(inner).copyTo(sky(inner));
  EXPECT_FALSE(ScaleFilter::look_at(sky, kAt, kSize));
}

TEST(ScaleFilter, LooksBeyondTheImage) {
  EXPECT_TRUE(ScaleFilter::look_at(picture(1.0), {-5.0, 300.0}, kSize));
}

}  // namespace
}  // namespace ols::tracker
