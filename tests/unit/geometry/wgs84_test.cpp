#include "geometry/wgs84.h"

#include <gtest/gtest.h>

#include "geometry/angles.h"
#include "geometry/direction.h"
#include "tests/unit/geometry/near.h"

namespace ols {
namespace {

using test::near;

constexpr double kEquatorialRadius = 6378137.0;
constexpr double kPolarRadius = 6356752.314245;

Geodetic at_deg(double latitude_deg, double longitude_deg, double height_m) {
  return {radians(latitude_deg), radians(longitude_deg), height_m};
}

TEST(Wgs84, AxesOfTheEllipsoid) {
  EXPECT_TRUE(near(ecef_from_geodetic({}), Eigen::Vector3d(kEquatorialRadius, 0.0, 0.0), 1e-6));
  EXPECT_TRUE(near(ecef_from_geodetic(at_deg(0.0, 90.0, 100.0)),
                   Eigen::Vector3d(0.0, kEquatorialRadius + 100.0, 0.0), 1e-6));
  EXPECT_TRUE(near(ecef_from_geodetic(at_deg(-90.0, 0.0, 10.0)),
                   Eigen::Vector3d(0.0, 0.0, -kPolarRadius - 10.0), 1e-6));
}

TEST(Wgs84, HalfWayToThePole) {
  // N = a / sqrt(1 - e^2 / 2) = 6388838.2901 m; x = N cos 45, z = N (1 - e^2) sin 45.
  EXPECT_TRUE(near(ecef_from_geodetic(at_deg(45.0, 0.0, 0.0)),
                   Eigen::Vector3d(4517590.8788, 0.0, 4487348.4088), 1e-3));
}

TEST(Wgs84, RoundTrip) {
  for (const double latitude_deg : {-90.0, -89.999999, -33.0, 0.0, 1e-7, 49.2, 89.9999999, 90.0}) {
    for (const double longitude_deg : {-179.9999999, -75.0, 0.0, 16.6, 180.0}) {
      for (const double height_m : {-400.0, 0.0, 310.0, 12e3, 400e3}) {
        const Geodetic position = at_deg(latitude_deg, longitude_deg, height_m);
        const Geodetic back = geodetic_from_ecef(ecef_from_geodetic(position));
        EXPECT_NEAR(back.latitude_rad, position.latitude_rad, 1e-15);
        EXPECT_NEAR(back.height_m, height_m, 3e-9);
        EXPECT_TRUE(near(ecef_from_geodetic(back), ecef_from_geodetic(position), 3e-9));
      }
    }
  }
}

TEST(Wgs84, AxesOfEastNorthUp) {
  // At the crossing of equator and prime meridian: east is Y, north is Z, up is X.
  Eigen::Matrix3d expected;
  expected << 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0;
  EXPECT_TRUE(near(R_ecef_enu(Geodetic{}), expected, 1e-15));
  EXPECT_TRUE(near(R_ecef_enu(ecef_from_geodetic({})), expected, 1e-15));
}

TEST(Wgs84, EastNorthUpIsTheWayThatLongitudeLatitudeHeightGrow) {
  const Geodetic here = at_deg(49.2, 16.6, 300.0);
  const double step_rad = 1e-6;
  const auto step = [&](double north_rad, double east_rad, double up_m) {
    return (ecef_from_geodetic({here.latitude_rad + north_rad, here.longitude_rad + east_rad,
                                here.height_m + up_m}) -
            ecef_from_geodetic({here.latitude_rad - north_rad, here.longitude_rad - east_rad,
                                here.height_m - up_m}))
        .normalized()
        .eval();
  };
  const Eigen::Matrix3d R = R_ecef_enu(here);
  EXPECT_TRUE(near(R.col(0), step(0.0, step_rad, 0.0), 1e-9));
  EXPECT_TRUE(near(R.col(1), step(step_rad, 0.0, 0.0), 1e-9));
  EXPECT_TRUE(near(R.col(2), step(0.0, 0.0, 10.0), 1e-9));
}

TEST(Wgs84, LocalFrameRoundTripAcrossTheDateline) {
  const LocalFrame frame(at_deg(-17.0, 179.9999, 20.0));
  const Eigen::Vector3d p_enu(50.0, -3.0, 7.0);
  const Geodetic beyond = geodetic_from_ecef(frame.to_ecef(p_enu));
  EXPECT_LT(beyond.longitude_rad, 0.0);
  EXPECT_TRUE(near(frame.to_enu(frame.to_ecef(p_enu)), p_enu, 5e-9));
  EXPECT_TRUE(near(frame.to_enu(frame.origin_ecef()), Eigen::Vector3d::Zero(), 0.0));
}

TEST(Wgs84, LocalFrameAtThePoleIsOrthonormal) {
  const LocalFrame frame(at_deg(90.0, 0.0, 0.0));
  EXPECT_TRUE(near(frame.R_ecef_enu() * frame.R_ecef_enu().transpose(), Eigen::Matrix3d::Identity(),
                   1e-14));
  EXPECT_NEAR(frame.to_ecef({0.0, 0.0, 5.0}).z(), kPolarRadius + 5.0, 1e-6);
}

TEST(Wgs84, VerticalsDifferByNearlyADegreeAtAHundredKilometres) {
  const Eigen::Vector3d up_here = R_ecef_enu(Geodetic{}).col(2);
  const Geodetic there = {0.0, 100e3 / kEquatorialRadius, 0.0};
  EXPECT_NEAR(degrees(angle_between(up_here, R_ecef_enu(there).col(2))), 0.898, 1e-3);
}

}  // namespace
}  // namespace ols
