#include "central/filter/coloured_noise.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/unit/central/scene.h"

namespace ols::fusion {
namespace {

// Bearings of a stationary object, their errors correlated by `same` from one frame to the next.
double inflation_of(double same, bool told = true) {
  constexpr double kNoise = 1e-4;
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  BiasModel errors;
  ColouredNoise noise;
  Eigen::Vector2d off = Eigen::Vector2d::Zero();
  double inflation = 1.0;
  for (int i = 0; i < 3000; ++i) {
    const double fresh = std::sqrt(1.0 - same * same);
    off = same * off + fresh * kNoise * Eigen::Vector2d(normal(random), normal(random));
    Ray ray = test::turned(test::ray_to("a", {0, 0, 0}, {0, 300, 50}, kNoise), off.x(), off.y());
    if (told) ray.sight.covariance_systematic = Eigen::Matrix2d::Identity() * kNoise * kNoise;
    const BearingMeasurement measurement =
        test::measurement_of(ray, 1'600'000'000'000'000 + i * 40'000);
    inflation = noise.observe(measurement, ray_frame(measurement.sight), errors);
  }
  return inflation;
}

TEST(ColouredNoise, WhiteNoiseCountsAsStated) { EXPECT_LT(inflation_of(0.0), 2.0); }

TEST(ColouredNoise, WhatIsTheSameInTheNextFrameCountsLess) {
  EXPECT_GT(inflation_of(0.97), 8.0);  // at most 1 + 2 * 0.3 s / 0.04 s
}

TEST(ColouredNoise, WhatIsSlowIsInTheBiasWhereNoneIsStated) {
  const double inflation = inflation_of(0.97, false);
  EXPECT_GT(inflation, 2.5);
  EXPECT_LT(inflation, 3.5);  // at most 1 + 2 * 0.05 s / 0.04 s
}

}  // namespace
}  // namespace ols::fusion
