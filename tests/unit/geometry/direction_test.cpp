#include "geometry/direction.h"

#include <gtest/gtest.h>

#include "geometry/angles.h"
#include "geometry/wgs84.h"
#include "tests/unit/geometry/near.h"

namespace ols {
namespace {

using test::near;

AzimuthElevation at_deg(double azimuth_deg, double elevation_deg) {
  return {radians(azimuth_deg), radians(elevation_deg)};
}

TEST(Direction, CardinalPoints) {
  const auto enu = enu_from_azimuth_elevation;
  EXPECT_TRUE(near(enu(at_deg(0, 0)), Eigen::Vector3d(0, 1, 0), 1e-15));
  EXPECT_TRUE(near(enu(at_deg(90, 0)), Eigen::Vector3d(1, 0, 0), 1e-15));
  EXPECT_TRUE(near(enu(at_deg(180, 0)), Eigen::Vector3d(0, -1, 0), 1e-15));
  EXPECT_TRUE(near(enu(at_deg(270, 30)), Eigen::Vector3d(-std::sqrt(0.75), 0, 0.5), 1e-15));
}

TEST(Direction, RoundTrip) {
  for (double azimuth_deg = 0.0; azimuth_deg < 360.0; azimuth_deg += 7.3) {
    for (const double elevation_deg : {-89.9, -30.0, 0.0, 1e-9, 45.0, 89.999}) {
      const AzimuthElevation direction = at_deg(azimuth_deg, elevation_deg);
      const auto back = azimuth_elevation_from_enu(1234.5 * enu_from_azimuth_elevation(direction));
      EXPECT_NEAR(wrap_pi(back.azimuth_rad - direction.azimuth_rad), 0.0, 1e-11);
      EXPECT_NEAR(back.elevation_rad, direction.elevation_rad, 1e-15);
    }
  }
}

TEST(Direction, AzimuthIsZeroAtZenithAndNadir) {
  const AzimuthElevation zenith = azimuth_elevation_from_enu({0.0, 0.0, 3.0});
  EXPECT_EQ(zenith.azimuth_rad, 0.0);
  EXPECT_EQ(zenith.elevation_rad, kPi / 2.0);
  const AzimuthElevation nadir = azimuth_elevation_from_enu({-0.0, -0.0, -1.0});
  EXPECT_EQ(nadir.azimuth_rad, 0.0);
  EXPECT_EQ(nadir.elevation_rad, -kPi / 2.0);
}

TEST(Direction, TangentBasisIsTheDerivative) {
  const double h = 1e-6;
  for (const double elevation_deg : {-70.0, 0.0, 25.0, 89.0}) {
    const AzimuthElevation d = at_deg(123.0, elevation_deg);
    const auto shifted = [&](double azimuth_rad, double elevation_rad) {
      return enu_from_azimuth_elevation(
          {d.azimuth_rad + azimuth_rad, d.elevation_rad + elevation_rad});
    };
    const Eigen::Vector3d by_azimuth = (shifted(h, 0) - shifted(-h, 0)) / (2.0 * h);
    const Eigen::Vector3d by_elevation = (shifted(0, h) - shifted(0, -h)) / (2.0 * h);
    const auto basis = tangent_basis(d);
    EXPECT_TRUE(near(basis.col(0) * std::cos(d.elevation_rad), by_azimuth, 1e-9));
    EXPECT_TRUE(near(basis.col(1), by_elevation, 1e-9));
    EXPECT_TRUE(near(basis.transpose() * basis, Eigen::Matrix2d::Identity(), 1e-15));
    EXPECT_TRUE(near(basis.transpose() * shifted(0, 0), Eigen::Vector2d::Zero(), 1e-15));
  }
}

TEST(Direction, AngleBetweenIsExactWhenTinyAndWhenStraight) {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  EXPECT_DOUBLE_EQ(angle_between(x, {1.0, 1e-12, 0.0}), 1e-12);
  EXPECT_DOUBLE_EQ(angle_between(x, {-5.0, 0.0, 0.0}), kPi);
  EXPECT_DOUBLE_EQ(angle_between(2.0 * x, {0.0, 0.0, 7.0}), kPi / 2.0);
}

TEST(Direction, SightLineKnowsItsOwnHorizon) {
  // On the equator at 90 degrees east, north is Z and east is -X.
  LineOfSight line;
  line.origin_ecef = ecef_from_geodetic({0.0, kPi / 2.0, 100.0});
  line.direction = at_deg(0, 0);
  EXPECT_TRUE(near(direction_ecef(line), Eigen::Vector3d::UnitZ(), 1e-15));
  line.direction = at_deg(90, 0);
  EXPECT_TRUE(near(direction_ecef(line), -Eigen::Vector3d::UnitX(), 1e-15));
  line.direction = at_deg(90, 90);
  EXPECT_TRUE(near(direction_ecef(line), Eigen::Vector3d::UnitY(), 1e-15));
}

}  // namespace
}  // namespace ols
