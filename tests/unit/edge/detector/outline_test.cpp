#include "edge/detector/outline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

namespace ols::detector {
namespace {

constexpr double kSky = 150.0;

// A dark ellipse before the sky, drawn sixteen times as fine in each direction and then averaged.
cv::Mat1f sky_with(const Eigen::Vector2d& centre, const Eigen::Vector2d& sides, double contrast,
                   cv::Size size = {80, 80}) {
  constexpr int kFine = 16;
  cv::Mat1f fine(size * kFine, static_cast<float>(kSky));
  const Eigen::Vector2d middle = (centre.array() + 0.5) * kFine;
  const cv::RotatedRect box(
      cv::Point2f(static_cast<float>(middle.x() - 0.5), static_cast<float>(middle.y() - 0.5)),
      cv::Size2f(static_cast<float>(kFine * sides.x()), static_cast<float>(kFine * sides.y())),
      0.0F);
  cv::ellipse(fine, box, cv::Scalar(kSky - contrast), cv::FILLED);
  cv::Mat1f picture;
  cv::resize(fine, picture, size, 0.0, 0.0, cv::INTER_AREA);
  return picture;
}

cv::Mat1b with_noise(const cv::Mat1f& picture, double noise, std::mt19937& random) {
  std::normal_distribution<float> normal(0.0F, static_cast<float>(noise));
  cv::Mat1b noisy(picture.size());
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x)
      noisy(y, x) = cv::saturate_cast<std::uint8_t>(picture(y, x) + normal(random));
  }
  return noisy;
}

TEST(Outline, IsThatOfAnEllipseToAFractionOfAPixel) {
  std::mt19937 random(1);
  for (const auto& [width, height] :
       {std::pair{6.0, 4.0}, {9.5, 6.2}, {17.3, 12.1}, {24.0, 24.0}}) {
    const Eigen::Vector2d sides(width, height);
    const cv::Mat1b sky = with_noise(sky_with({40.3, 39.8}, sides, 80.0), 1.0, random);
    const auto outline = outline_at(sky, {40.0, 40.0}, sides.maxCoeff());
    ASSERT_TRUE(outline) << width;
    // The pixel's own width, in quadrature.
    const Eigen::Vector2d expected = (sides.array().square() + 16.0 / 12.0).sqrt();
    EXPECT_LT((outline->size_px - expected).cwiseAbs().maxCoeff(), 0.15)
        << outline->size_px.transpose() << ", expected " << expected.transpose();
  }
}

TEST(Outline, StatesTheScatterThatTheNoiseCauses) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> within(-0.5, 0.5);
  for (const double contrast : {25.0, 100.0}) {
    Eigen::Array2d squares = Eigen::Array2d::Zero(), told = squares;
    const Eigen::Vector2d sides(12.0, 7.0);
    std::vector<Eigen::Array2d> seen;
    for (int i = 0; i < 200; ++i) {
      const Eigen::Vector2d centre(40.0 + within(random), 40.0 + within(random));
      const auto outline = outline_at(with_noise(sky_with(centre, sides, contrast), 2.0, random),
                                      {40.0, 40.0}, 12.0);
      ASSERT_TRUE(outline);
      seen.emplace_back(outline->size_px);
      told += outline->sd_px.array().square();
    }
    Eigen::Array2d mean = Eigen::Array2d::Zero();
    for (const auto& one : seen) mean += one / 200.0;
    for (const auto& one : seen) squares += (one - mean).square();
    const Eigen::Array2d ratio = (told / squares).sqrt();
    EXPECT_GT(ratio.minCoeff(), 0.7) << contrast;
    EXPECT_LT(ratio.maxCoeff(), 1.5) << contrast;
  }
}

// The detection's box is a whole number of a level's pixels: from image to image by a third.
TEST(Outline, OfARigidBodyStaysAndOfBeatingWingsChanges) {
  std::mt19937 random(3);
  double least = 1e9, most = 0.0;
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector2d centre(40.0 + 0.37 * i, 40.0 + 0.19 * i);
    const auto outline = outline_at(with_noise(sky_with(centre, {8.0, 5.0}, 60.0), 2.0, random),
                                    centre, 6.0 + 4.0 * (i % 2));
    ASSERT_TRUE(outline);
    least = std::min(least, outline->size_px.x());
    most = std::max(most, outline->size_px.x());
  }
  EXPECT_LT(most / least, 1.1);
  const auto folded = outline_at(with_noise(sky_with({40.0, 40.0}, {6.4, 5.0}, 60.0), 2.0, random),
                                 {40.0, 40.0}, 8.0);
  ASSERT_TRUE(folded);
  EXPECT_LT(folded->size_px.x() / least, 0.9);
}

TEST(Outline, MayBeBrighterThanTheSkyAndDarkerInPlaces) {
  std::mt19937 random(7);
  const Eigen::Vector2d sides(14.0, 10.0);
  const cv::Mat1f bright = sky_with({40.0, 40.0}, sides, -60.0);
  const auto outline = outline_at(with_noise(bright, 2.0, random), {40.0, 40.0}, 14.0);
  ASSERT_TRUE(outline);
  EXPECT_LT((outline->size_px - sides).cwiseAbs().maxCoeff(), 0.3);
  cv::Mat1f mixed = bright.clone();  // its left half
  mixed.colRange(0, 40) = 2.0 * kSky - mixed.colRange(0, 40);
  const auto both = outline_at(with_noise(mixed, 2.0, random), {40.0, 40.0}, 14.0);
  ASSERT_TRUE(both);
  EXPECT_LT((both->size_px - sides).cwiseAbs().maxCoeff(), 1.0);
  cv::Mat1f stripes(80, 80, static_cast<float>(kSky));
  for (int x = 34; x < 46; ++x)
    stripes.col(x).rowRange(35, 45) = kSky + (x % 2 == 0 ? 100.0 : -100.0);
  const auto fine = outline_at(with_noise(stripes, 1.0, random), {40.0, 40.0}, 12.0);
  EXPECT_FALSE(fine) << "its parts cancel";
}

// Without the plane, the slope would count as a texture, and hide most of the object.
TEST(Outline, StandsOutBeforeASlopeOfGreyLevels) {
  std::mt19937 random(8);
  const Eigen::Vector2d sides(14.0, 10.0);
  cv::Mat1f sloping = sky_with({40.0, 40.0}, sides, 60.0);
  for (int y = 0; y < sloping.rows; ++y) {
    for (int x = 0; x < sloping.cols; ++x) sloping(y, x) += 0.8F * (x - 40) + 0.4F * (y - 40);
  }
  const auto outline = outline_at(with_noise(sloping, 1.0, random), {40.0, 40.0}, 14.0);
  ASSERT_TRUE(outline);
  EXPECT_LT((outline->size_px - sides).cwiseAbs().maxCoeff(), 0.3);
}

TEST(Outline, OfALargeObjectIsMeasuredInAReducedImage) {
  std::mt19937 random(4);
  const cv::Mat1b sky =
      with_noise(sky_with({300.0, 300.0}, {200.0, 90.0}, 60.0, {600, 600}), 2.0, random);
  const auto outline = outline_at(sky, {302.0, 297.0}, 200.0);
  ASSERT_TRUE(outline);
  EXPECT_NEAR(outline->size_px.x(), 200.0, 2.0);
  EXPECT_NEAR(outline->size_px.y(), 90.0, 2.0);
  EXPECT_LT(outline->sd_px.maxCoeff(), 0.5);
}

TEST(Outline, IsUnknownWithoutClearSurroundings) {
  std::mt19937 random(5);
  const cv::Mat1f alone = sky_with({40.0, 40.0}, {10.0, 10.0}, 60.0);
  EXPECT_FALSE(outline_at(with_noise(cv::Mat1f(80, 80, 150.0F), 2.0, random), {40.0, 40.0}, 10.0))
      << "nothing there";
  EXPECT_FALSE(outline_at(with_noise(alone, 2.0, random), {75.0, 40.0}, 10.0)) << "the image ends";
  cv::Mat1f leaves = with_noise(cv::Mat1f(80, 80, 0.0F) + 128.0F, 30.0, random);
  cv::GaussianBlur(leaves, leaves, {}, 1.5);
  const cv::Mat1f before_leaves = alone + (leaves - 128.0F);
  EXPECT_FALSE(outline_at(with_noise(before_leaves, 2.0, random), {40.0, 40.0}, 10.0));
  cv::Mat1f mast = alone.clone();
  mast.colRange(39, 42).rowRange(40, 80) = 90.0F;
  EXPECT_FALSE(outline_at(with_noise(mast, 2.0, random), {40.0, 40.0}, 10.0)) << "it hangs on more";
}

TEST(Outline, LeavesANeighbourOut) {
  std::mt19937 random(6);
  cv::Mat1f two = sky_with({40.0, 40.0}, {10.0, 6.0}, 60.0);
  two = cv::min(two, sky_with({40.0, 48.5}, {3.0, 3.0}, 60.0));
  const auto outline = outline_at(with_noise(two, 2.0, random), {40.0, 40.0}, 10.0);
  ASSERT_TRUE(outline);
  EXPECT_NEAR(outline->size_px.y(), 6.0, 0.3);
}

}  // namespace
}  // namespace ols::detector
