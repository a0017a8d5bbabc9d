#include "central/ground/visibility.h"

#include <gtest/gtest.h>

#include "tests/unit/central/ground/lands.h"

namespace ols::fusion {
namespace {

TEST(Visibility, OfPlacesBehindAndBeforeARidge) {
  struct Case {
    const char* what;
    double east_m, above_m;
    Eigen::Vector3d sd_m;
    double visible, plausible;  // +/- 0.04
  };
  // The camera is as high as the ridge.
  const Case cases[] = {
      {"before it", 450.0, 10.0, {1.0, 1.0, 1.0}, 1.0, 1.0},
      {"behind it", 1000.0, 10.0, {5.0, 1.0, 1.0}, 0.0, 0.0},
      {"behind it by less than the line's uncertainty", 600.0, 10.0, {40.0, 1.0, 1.0}, 1.0, 1.0},
      {"at its edge", 1000.0, 50.0, {5.0, 1.0, 1.0}, 0.5, 0.5},
      {"a sigma above its edge",
       1000.0,
       50.0 + 2.0 * std::hypot(1.0, 0.5),
       {5.0, 1.0, 1.0},
       0.841,
       0.841},
      {"high above it", 1000.0, 200.0, {5.0, 1.0, 1.0}, 1.0, 1.0},
      {"below the ground", 450.0, -20.0, {1.0, 1.0, 1.0}, 0.0, 0.0},
      {"on the ground", 450.0, 0.0, {1.0, 1.0, 1.0}, 0.93, 0.5},
      {"beyond the known land", 20e3, 2000.0, {5.0, 1.0, 1.0}, 1.0, 1.0},
  };
  const Land land(ridge);
  const Eigen::Vector3d camera = land.at(0.0, 0.0, 50.0);
  for (const Case& c : cases) {
    SCOPED_TRACE(c.what);
    const Eigen::Vector3d p = land.at(c.east_m, 0.0, c.above_m);
    const Eigen::Matrix3d P = enu_covariance(p, c.sd_m);
    EXPECT_NEAR(visibility(land, camera, p, P), c.visible, 0.04);
    EXPECT_NEAR(plausibility(land, camera, p, P), c.plausible, 0.04);
  }
}

// A camera on a roof that the model has too high by 2 m, and 30 m too long.
TEST(Visibility, IsNotOfWhatCoversTheCamera) {
  const Land land([](double east_m, double) { return east_m < 40.0 ? 12.0 : 0.0; }, 0.1);
  const Eigen::Vector3d camera = land.at(0.0, 0.0, 10.0), p = land.at(400.0, 0.0, 20.0);
  EXPECT_GT(visibility(land, camera, p, enu_covariance(p, {1.0, 1.0, 1.0})), 0.99);
}

}  // namespace
}  // namespace ols::fusion
