#include "calibration/pictures/star_detection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "scenery.h"

namespace ols::calibration {
namespace {

using Eigen::Vector2d;

struct Sky {
  cv::Mat light = cv::Mat(480, 640, CV_32F, cv::Scalar(12.0));

  void star(const Vector2d& at, double flux, double sigma = 0.9) {
    for (int y = -8; y <= 8; ++y) {
      for (int x = -8; x <= 8; ++x) {
        const int px = static_cast<int>(std::lround(at.x())) + x;
        const int py = static_cast<int>(std::lround(at.y())) + y;
        const double r2 = std::pow(px - at.x(), 2) + std::pow(py - at.y(), 2);
        light.at<float>(py, px) += static_cast<float>(flux / (2.0 * CV_PI * sigma * sigma) *
                                                      std::exp(-0.5 * r2 / (sigma * sigma)));
      }
    }
  }
  cv::Mat seen(unsigned seed) const { return Scenery::with_noise(light, seed, 2.0); }
};

const DetectedStar* nearest(const StarField& field, const Vector2d& at) {
  for (const DetectedStar& star : field.stars) {
    if ((star.centre_px - at).norm() < 1.5) return &star;
  }
  return nullptr;
}

TEST(StarDetection, StarsAreCentredAsWellAsStated) {
  std::mt19937 generator(4);
  std::uniform_real_distribution<double> x(20.0, 620.0), y(20.0, 460.0), flux(120.0, 1200.0);
  double squares = 0.0, told = 0.0;
  int n = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    Sky sky;
    std::vector<Vector2d> places;
    while (places.size() < 12) {
      const Vector2d place(x(generator), y(generator));
      const bool alone = std::ranges::none_of(
          places, [&](const Vector2d& other) { return (other - place).norm() < 25.0; });
      if (!alone) continue;
      places.push_back(place);
      sky.star(place, flux(generator));
    }
    const StarField field = detect_stars(sky.seen(seed));
    EXPECT_LE(field.stars.size(), 13U);
    for (const Vector2d& place : places) {
      const DetectedStar* star = nearest(field, place);
      ASSERT_NE(star, nullptr) << place.transpose();
      squares += (star->centre_px - place).squaredNorm();
      told += 2.0 * star->sd_px * star->sd_px;
      ++n;
    }
  }
  std::printf("rms %.4f told %.4f px, %d stars\n", std::sqrt(squares / (2 * n)),
              std::sqrt(told / (2 * n)), n);
  EXPECT_LT(std::sqrt(squares / (2 * n)), 0.12);
  EXPECT_GT(std::sqrt(told / squares), 0.7);
  EXPECT_LT(std::sqrt(told / squares), 1.5);
}

TEST(StarDetection, HotPixelsStreaksAndLitSurfacesAreRefused) {
  Sky sky;
  sky.star({100.4, 100.6}, 800.0);
  sky.light.at<float>(200, 300) += 150.0F;
  sky.light.at<float>(301, 77) += 90.0F;
  cv::Mat streak = cv::Mat::zeros(sky.light.size(), CV_32F);
  cv::line(streak, {400, 80}, {450, 110}, 200.0, 1);
  cv::GaussianBlur(streak, streak, {}, 0.9);
  cv::Mat tower = cv::Mat::zeros(sky.light.size(), CV_32F);
  cv::rectangle(tower, cv::Rect(500, 300, 40, 45), 80.0, cv::FILLED);
  sky.light += streak + tower;
  const StarField field = detect_stars(sky.seen(3));
  EXPECT_EQ(field.hot_pixels, 2);
  EXPECT_EQ(field.streaks, 1);
  EXPECT_GE(field.surfaces, 1);
  ASSERT_NE(nearest(field, {100.4, 100.6}), nullptr);
  EXPECT_EQ(nearest(field, {300.0, 200.0}), nullptr);
  EXPECT_EQ(nearest(field, {425.0, 95.0}), nullptr);
  EXPECT_LE(field.stars.size(), 2U);
}

TEST(StarDetection, ASaturatedStarIsMarkedAndLessCertain) {
  Sky sky;
  sky.star({200.3, 200.3}, 6000.0);
  const StarField field = detect_stars(sky.seen(1));
  ASSERT_EQ(field.stars.size(), 1U);
  EXPECT_TRUE(field.stars.front().saturated);
  EXPECT_GT(field.stars.front().sd_px, 0.2);
}

TEST(StarDetection, AnEmptySkyHasNone) {
  int found = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    found += static_cast<int>(detect_stars(Sky().seen(seed)).stars.size());
  }
  EXPECT_LE(found, 2);  // at five sigma 0.3 in a million pixels
  EXPECT_TRUE(detect_stars(cv::Mat()).stars.empty());
}

}  // namespace
}  // namespace ols::calibration
