#include "sim/world/texture.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sim/scenario/normal.h"

namespace ols::sim {
namespace {

TEST(Texture, NoiseHasZeroMeanAndUnitDeviation) {
  std::mt19937_64 generator(1);
  const cv::Mat noise = fractal_noise({256, 128}, 64, 4, 0.6, generator);
  cv::Scalar mean, deviation;
  cv::meanStdDev(noise, mean, deviation);
  EXPECT_NEAR(mean[0], 0.0, 1e-3);
  EXPECT_NEAR(deviation[0], 1.0, 1e-3);
}

// The step from the last column to the first is like any other.
TEST(Texture, NoiseIsPeriodic) {
  std::mt19937_64 generator(2);
  const cv::Mat noise = fractal_noise({256, 256}, 64, 16, 0.5, generator);
  const double seam = cv::norm(noise.col(0), noise.col(255), cv::NORM_L2);
  const double inside = cv::norm(noise.col(100), noise.col(101), cv::NORM_L2);
  EXPECT_LT(seam, 2.0 * inside);
}

TEST(Texture, ASeedGivesOneWood) {
  std::mt19937_64 one(3), same(3), other(4);
  const cv::Mat wood_of_one = wood(128, one);
  EXPECT_EQ(cv::norm(wood_of_one, wood(128, same), cv::NORM_INF), 0.0);
  EXPECT_GT(cv::norm(wood_of_one, wood(128, other), cv::NORM_INF), 0.0);
}

TEST(Texture, TreeTopsStandOnTheLine) {
  std::mt19937_64 generator(5);
  const std::vector<float> tops = tree_tops(1000, generator);
  ASSERT_EQ(tops.size(), 1000U);
  EXPECT_TRUE(std::ranges::all_of(tops, [](float top) { return top >= 0.0F && top <= 38.0F; }));
  EXPECT_GT(*std::ranges::max_element(tops), 5.0F);
}

template <typename Real>
void expect_the_librarys_numbers() {
  std::mt19937_64 own(3), librarys(3);
  Normal<Real> normal;
  std::normal_distribution<Real> same;
  for (int i = 0; i < 1000; ++i) ASSERT_EQ(normal(own), same(librarys)) << i;
}

TEST(Normal, NumbersAreThoseOfTheLibrary) {
  expect_the_librarys_numbers<float>();
  expect_the_librarys_numbers<double>();
}

}  // namespace
}  // namespace ols::sim
