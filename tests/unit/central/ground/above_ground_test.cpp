#include "central/ground/above_ground.h"

#include <gtest/gtest.h>

#include "tests/unit/central/ground/lands.h"

namespace ols::fusion {
namespace {

TEST(AboveGround, HeightAndItsSigma) {
  struct Case {
    const char* what;
    Land::Height ground;
    double east_m, height_m;
    Eigen::Vector3d sd_m;
    double above_m, above_sd_m;
  };
  const auto slope = [](double east_m, double) { return 0.5 * east_m; };
  const auto dome = [](double east_m, double north_m) {
    return -(east_m * east_m + north_m * north_m) / 1000.0;
  };
  const Case cases[] = {
      {"flat", flat, 100.0, 30.0, {3.0, 3.0, 2.0}, 30.0, std::hypot(2.0, 1.0)},
      {"below the ground", flat, 100.0, -5.0, {3.0, 3.0, 2.0}, -5.0, std::hypot(2.0, 1.0)},
      // A metre east is half a metre of height.
      {"slope", slope, 200.0, 130.0, {4.0, 9.0, 2.0}, 30.0, std::sqrt(4.0 + 4.0 + 1.0)},
      // Over 100 m each way the dome falls by 10 m.
      {"dome", dome, 0.0, 40.0, {100.0, 100.0, 2.0}, 40.0, std::sqrt(4.0 + 1.0 + 200.0)},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.what);
    const Land land(c.ground);
    const Eigen::Vector3d p = land.at(c.east_m, 0.0, c.height_m);
    const auto above = height_above_ground(land, p, enu_covariance(p, c.sd_m));
    ASSERT_TRUE(above);
    EXPECT_NEAR(above->height_m, c.above_m, 0.01);
    EXPECT_NEAR(above->sd_m, c.above_sd_m, 0.01);
  }
  const Land land(flat);
  const Eigen::Vector3d far = land.at(16e3, 0.0, 30.0);
  EXPECT_FALSE(height_above_ground(land, far, Eigen::Matrix3d::Identity()));
}

TEST(AboveGround, PuttingOnASlopeShortensTheLine) {
  const Land land([](double east_m, double) { return 0.5 * east_m; }, 0.5);
  const Eigen::Vector3d truth = land.on_ground(400.0, 0.0, kMiddle_m);
  // 20 m along the horizontal line of sight east, which is certain otherwise.
  const Eigen::Matrix3d P = enu_covariance(truth, {20.0, 0.3, 0.1});
  const Eigen::Vector3d found = truth + R_ecef_enu(truth).col(0) * 25.0;
  const auto placed = put_on_ground(land, {found, P});
  ASSERT_TRUE(placed);
  EXPECT_LT((placed->p_ecef - truth).norm(), 0.5);
  const Eigen::Matrix3d R = R_ecef_enu(truth);
  const double sd_m = std::sqrt((R.transpose() * placed->covariance_ecef * R)(0, 0));
  const double height_sd_m = std::hypot(0.5, kMiddleSd_m, 0.1);
  EXPECT_NEAR(sd_m, height_sd_m / 0.5, 0.05);
  // 60 m above: not on the ground, whatever was said.
  EXPECT_FALSE(put_on_ground(land, {land.on_ground(400.0, 0.0, 60.0), P}));
}

}  // namespace
}  // namespace ols::fusion
