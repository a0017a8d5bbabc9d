#include "calibration/zoom_fit.h"

#include <gtest/gtest.h>

#include <random>

namespace ols::calibration {
namespace {

// A lens of 4000 px, and what was believed of it.
struct Scenery {
  StationGeometry truth, believed;
  std::vector<PanTilt> angles;  // as the unit counts them
  std::vector<ZoomPair> pairs;
};

Scenery scenery(std::uint64_t seed, double angle_sd_rad, double pixel_sd_px) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> where(0.0, 1.0);
  Scenery made;
  made.truth.camera.fx_px = made.truth.camera.fy_px = 4000.0;
  made.truth.camera.k1 = -0.25;
  made.believed = made.truth;
  made.believed.camera.fx_px = made.believed.camera.fy_px = 3700.0;
  made.believed.camera.k1 = -0.23;
  std::vector<PanTilt> shaft;
  for (int i = -3; i <= 3; ++i) {
    made.angles.push_back({0.06 * i, 0.05});
    shaft.push_back(
        {0.06 * i + angle_sd_rad * normal(random), 0.05 + angle_sd_rad * normal(random)});
  }
  const auto attitude = [&](std::size_t i) -> Eigen::Matrix3d {
    return enu_from_camera(made.truth.chain, shaft[i]).linear();
  };
  for (std::size_t i = 0; i + 1 < shaft.size(); ++i) {
    for (int k = 0; k < 40; ++k) {
      const Eigen::Vector2d pixel(1280.0 * where(random), 960.0 * where(random));
      const auto there =
          project(made.truth.camera, attitude(i + 1).transpose() * attitude(i) *
                                         unproject(made.truth.camera, pixel).value());
      if (!there || there->x() < 0.0 || there->x() > 1279.0) continue;
      const Eigen::Vector2d noise(normal(random), normal(random));
      made.pairs.push_back({i, i + 1, pixel, *there + pixel_sd_px * noise, pixel_sd_px});
    }
  }
  return made;
}

TEST(ZoomFit, ExactObservationsGiveTheFocalLength) {
  const Scenery made = scenery(1, 0.0, 1e-4);
  const ZoomFit fit = fit_zoom(made.believed, made.angles, made.pairs);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit.point.camera.fx_px, 4000.0, 0.1);
  EXPECT_EQ(fit.point.camera.fx_px, fit.point.camera.fy_px);
  EXPECT_NEAR(fit.point.camera.k1, -0.25, 1e-3);
}

TEST(ZoomFit, TheDeviationSaysHowWrongItIs) {
  double squared = 0.0;
  constexpr int kRuns = 15;
  for (int seed = 1; seed <= kRuns; ++seed) {
    const Scenery made = scenery(static_cast<std::uint64_t>(seed), 5e-5, 0.15);
    const ZoomFit fit = fit_zoom(made.believed, made.angles, made.pairs, {.angle_sd_rad = 5e-5});
    ASSERT_TRUE(fit);
    const double error = (fit.point.camera.fx_px - 4000.0) / fit.point.focal_sd_px;
    squared += error * error;
    EXPECT_LT(fit.point.focal_sd_px, 8.0);
    EXPECT_NEAR(fit.rms_sd, 1.0, 0.15);
  }
  EXPECT_GT(squared / kRuns, 0.35);
  EXPECT_LT(squared / kRuns, 1.9);
}

// A third of the points, all in one direction.
TEST(ZoomFit, WhatMovesIsLeftOut) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    SCOPED_TRACE(seed);
    Scenery made = scenery(seed, 0.0, 0.1);
    int still = 0;
    for (std::size_t i = 0; i < made.pairs.size(); ++i) {
      if (i % 3 == 0) made.pairs[i].second_px += Eigen::Vector2d(12.0, -7.0);
      if (i % 3 != 0) ++still;
    }
    const ZoomFit fit = fit_zoom(made.believed, made.angles, made.pairs);
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit.point.camera.fx_px, 4000.0, 3.0 * fit.point.focal_sd_px);
    EXPECT_LE(fit.used, still);
    EXPECT_GT(fit.used, still * 9 / 10);
  }
}

TEST(ZoomFit, TooLittleIsNothing) {
  Scenery made = scenery(4, 0.0, 0.1);
  made.pairs.resize(8);
  EXPECT_FALSE(fit_zoom(made.believed, made.angles, made.pairs));
}

}  // namespace
}  // namespace ols::calibration
