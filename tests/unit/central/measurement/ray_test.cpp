#include "central/measurement/ray.h"

#include <gtest/gtest.h>

#include "central/measurement/place_axes.h"
#include "geometry/wgs84.h"
#include "tests/unit/central/scene.h"

namespace ols::fusion {
namespace {

using Eigen::Vector3d;

TEST(PlaceAxes, AreThoseOfEachPlaceInTurn) {
  const Eigen::Vector3d here = ecef_from_geodetic({0.86, 0.29, 250.0});
  const Eigen::Vector3d there = ecef_from_geodetic({0.87, 0.29, 250.0});
  PlaceAxes axes;
  for (const Eigen::Vector3d& place : {here, here, there, here}) {
    EXPECT_EQ(axes.R_ecef_enu(place), R_ecef_enu(place));
  }
}

TEST(Ray, ItsFrameIsRightHandedAndPointsWhereItLooks) {
  const Vector3d from(10.0, -20.0, 0.0), to(110.0, 80.0, 60.0);
  const RayFrame frame = ray_frame(test::ray_to("a", from, to).sight);
  const Vector3d line = test::site().to_ecef(to) - test::site().to_ecef(from);
  EXPECT_NEAR((frame.direction - line.normalized()).norm(), 0.0, 1e-9);
  EXPECT_NEAR((frame.tangent.transpose() * frame.direction).norm(), 0.0, 1e-12);
}

TEST(Ray, APlacesErrorIsSeenFromTheRange) {
  LineOfSight sight = test::ray_to("a", {0, 0, 0}, {0, 300, 0}).sight;
  sight.origin_sd_enu_m = Vector3d(0.3, 0.6, 0.9);
  const Eigen::Matrix2d seen = stated_covariance(sight, 300.0);
  EXPECT_NEAR(std::sqrt(seen(0, 0)), 1e-3, 1e-6);  // north: across is east,
  EXPECT_NEAR(std::sqrt(seen(1, 1)), 3e-3, 1e-6);  // and up is up
}

TEST(Ray, TheCrossingAngleIsFoldedAndOfTheUsedRaysAlone) {
  const Vector3d target(0.0, 100.0, 0.0);
  const std::vector<Ray> rays =
      test::rays_from({{0, 0, 0}, {100, 100, 0}, {0, 200.0001, 0}}, target);
  std::vector<RayUse> use(3, RayUse{.used = true});
  EXPECT_NEAR(crossing_angle(rays, use), kPi / 2.0, 1e-5);
  use[1].used = false;
  EXPECT_NEAR(crossing_angle(rays, use), 0.0, 1e-4);
}

}  // namespace
}  // namespace ols::fusion
