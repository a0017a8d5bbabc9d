#include "calibration/pictures/line_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ols::calibration {
namespace {

// A third of the points belong to something else.
TEST(LineFit, WhatDoesNotBelongToTheLineIsLeftOut) {
  std::mt19937 random(4);
  std::normal_distribution<double> noise(0.0, 0.2);
  LinePoints points;
  for (int x = 0; x < 300; ++x) {
    points.x.push_back(x);
    points.y.push_back(x % 3 == 0 ? 55.0 + 3.0 * std::sin(x) : 40.0 + 0.03 * x + noise(random));
  }
  const auto line = fit_line(points, {.offset = 40.0, .slope = 0.029});
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->slope, 0.03, 0.001);
  EXPECT_NEAR(line->offset, 40.0 + 0.03 * line->middle, 0.1);
  EXPECT_NEAR(line->rms_px, 0.2, 0.03);
  EXPECT_NEAR(static_cast<double>(line->columns), 200.0, 10.0);
  EXPECT_NEAR(line->gyration_px, 300.0 / std::sqrt(12.0), 3.0);
}

TEST(LineFit, PointsOnALineAreNotOffIt) {
  LinePoints points;
  for (int x = 0; x < 100; ++x) {
    points.x.push_back(x);
    points.y.push_back(7.0 - 0.25 * x);
  }
  const auto line = fit_line(points, {.offset = 7.0, .slope = -0.24});
  ASSERT_TRUE(line);
  EXPECT_EQ(line->columns, 100U);
  EXPECT_NEAR(line->rms_px, 0.0, 1e-6);
}

TEST(LineFit, AFewPointsAreNoLine) {
  EXPECT_FALSE(fit_line({{1, 2, 3, 4, 5}, {1, 1, 1, 1, 1}}, {}));
}

}  // namespace
}  // namespace ols::calibration
