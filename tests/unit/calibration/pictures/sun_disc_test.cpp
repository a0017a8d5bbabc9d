#include "calibration/pictures/sun_disc.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ols::calibration {
namespace {

constexpr double kFocal_px = 13333.3;
constexpr double kRadius_px = 62.03;  // 959.63 arc seconds

// The sun through a filter: dark to its limb by a third, its edge as wide as the lens makes it.
cv::Mat sun(double x_px, double y_px, double radius_px, double noise, std::uint64_t seed = 1) {
  cv::Mat picture(480, 640, CV_32F);
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      const double r = std::hypot(x - x_px, y - y_px);
      const double mu = r < radius_px ? std::sqrt(1.0 - r * r / (radius_px * radius_px)) : 0.0;
      const double inside = 1.0 / (1.0 + std::exp((r - radius_px) / 0.5));
      picture.at<float>(y, x) = static_cast<float>(2.0 + 190.0 * inside * (0.65 + 0.35 * mu));
    }
  }
  cv::Mat noisy(picture.size(), CV_32F), gray;
  cv::RNG random(seed);
  random.fill(noisy, cv::RNG::NORMAL, 0.0, noise);
  picture += noisy;
  picture.convertTo(gray, CV_8U);
  return gray;
}

TEST(SunDisc, ItsCentreIsFoundToAFractionOfAPixel) {
  for (const auto& [x, y] : {std::pair{320.0, 240.0}, {101.37, 92.81}, {539.62, 385.13}}) {
    const SunDisc disc = find_sun(sun(x, y, 1.012 * kRadius_px, 2.0), kFocal_px);
    ASSERT_TRUE(disc) << to_string(disc.refusal);
    EXPECT_NEAR(disc.centre_px.x(), x, 0.1);
    EXPECT_NEAR(disc.centre_px.y(), y, 0.1);
    EXPECT_GE(disc.sd_px, 0.05);
    EXPECT_LT(disc.sd_px, 0.2);
  }
}

TEST(SunDisc, AnythingElseIsRefused) {
  using Refusal = SunDisc::Refusal;
  EXPECT_EQ(find_sun(cv::Mat(480, 640, CV_8U, cv::Scalar(3)), kFocal_px).refusal, Refusal::kNoDisc);
  EXPECT_EQ(find_sun(sun(20.0, 240.0, kRadius_px, 2.0), kFocal_px).refusal, Refusal::kAtTheEdge);
  EXPECT_EQ(find_sun(sun(320.0, 240.0, 0.5 * kRadius_px, 2.0), kFocal_px).refusal,
            Refusal::kOtherSize);
  cv::Mat two = sun(200.0, 240.0, kRadius_px, 2.0);
  two = cv::max(two, sun(430.0, 240.0, kRadius_px, 2.0));
  EXPECT_EQ(find_sun(two, kFocal_px).refusal, Refusal::kNoDisc);
  cv::Mat cloud = sun(320.0, 240.0, kRadius_px, 2.0);
  cloud(cv::Rect(250, 265, 140, 60)) *= 0.25;
  const SunDisc veiled = find_sun(cloud, kFocal_px);
  EXPECT_FALSE(veiled);
}

TEST(SunDisc, BlackIsWhatShowsNothing) {
  cv::Mat black(480, 640, CV_8U, cv::Scalar(3));
  black.at<unsigned char>(7, 9) = 255;  // a hot pixel
  EXPECT_TRUE(is_black(black));
  EXPECT_FALSE(is_black(cv::Mat(480, 640, CV_8U, cv::Scalar(60)))) << "the sky";
  EXPECT_FALSE(is_black(sun(320.0, 240.0, kRadius_px, 2.0))) << "the sun itself";
  cv::Mat horizon(480, 640, CV_8U, cv::Scalar(2));
  horizon(cv::Rect(0, 460, 640, 20)) = 90;
  EXPECT_FALSE(is_black(horizon));
}

}  // namespace
}  // namespace ols::calibration
