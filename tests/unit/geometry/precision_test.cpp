#include "geometry/precision.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "geometry/angles.h"
#include "tests/unit/geometry/near.h"

namespace ols {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::near;

const Geodetic kSite{radians(49.2), radians(16.6), 300.0};

PlannedStation station_at(const LocalFrame& site, const Vector3d& p_enu, double white_rad = 1e-4) {
  return {LocalFrame(geodetic_from_ecef(site.to_ecef(p_enu))), white_rad, {}, 0.0};
}

std::vector<PlannedStation> four(const LocalFrame& site) {
  return {station_at(site, {-300, 0, 0}), station_at(site, {300, 20, 5}),
          station_at(site, {0, 350, -3}), station_at(site, {40, -320, 8})};
}

Matrix3d enu_at(const Vector3d& p_ecef, const Matrix3d& covariance_ecef) {
  const Matrix3d R = R_ecef_enu(p_ecef);
  return R.transpose() * covariance_ecef * R;
}

TEST(BearingJacobian, MatchesDifferencesNearAndAt100km) {
  const LocalFrame station(kSite);
  for (const Vector3d& p_enu : {Vector3d(50, -20, 10), Vector3d(-70e3, 40e3, 60e3)}) {
    const Vector3d p = station.to_ecef(p_enu);
    const auto H = bearing_jacobian(station, p);
    const double step = 1e-5 * p_enu.norm();
    for (int axis = 0; axis < 3; ++axis) {
      const auto direction = [&](double d) {
        return azimuth_elevation_from_enu(station.to_enu(p + d * Vector3d::Unit(axis)));
      };
      const auto after = direction(step), before = direction(-step);
      const double cosine = std::cos(direction(0.0).elevation_rad);
      const double cross = cosine * wrap_pi(after.azimuth_rad - before.azimuth_rad) / (2.0 * step);
      const double up = (after.elevation_rad - before.elevation_rad) / (2.0 * step);
      EXPECT_NEAR(H(0, axis) * p_enu.norm(), cross * p_enu.norm(), 1e-6);
      EXPECT_NEAR(H(1, axis) * p_enu.norm(), up * p_enu.norm(), 1e-6);
    }
  }
}

// Two stations look at right angles: each fixes what lies across its own ray.
TEST(CramerRao, RightAngleHandComputed) {
  const LocalFrame site(kSite);
  const std::vector<PlannedStation> stations = {station_at(site, {-200, 0, 0}, 1e-3),
                                                station_at(site, {0, -100, 0}, 1e-3)};
  const PlannedTarget target{site.to_ecef({0, 0, 0})};
  const auto precision = position_precision(stations, target);
  ASSERT_TRUE(precision);
  const Matrix3d C = enu_at(target.p_ecef, precision->covariance_ecef);
  EXPECT_NEAR(C(0, 0), 0.1 * 0.1, 1e-6);  // 100 m * 1 mrad
  EXPECT_NEAR(C(1, 1), 0.2 * 0.2, 1e-6);
  EXPECT_NEAR(C(2, 2), 1.0 / (1.0 / 0.01 + 1.0 / 0.04), 1e-6);
  EXPECT_NEAR(C(0, 1), 0.0, 1e-6);
}

// A narrow pair: the depth of a target at D in front of a base b is known to
// sqrt(2) D^2 / b sigma, across it to D sigma / sqrt(2), for D much greater than b.
TEST(CramerRao, NarrowPairHandComputed) {
  const LocalFrame site(kSite);
  const double b = 30.0, D = 3000.0, sigma = 1e-5;
  const std::vector<PlannedStation> stations = {station_at(site, {-b / 2, 0, 0}, sigma),
                                                station_at(site, {b / 2, 0, 0}, sigma)};
  const auto precision = position_precision(stations, {site.to_ecef({0, D, 0})});
  ASSERT_TRUE(precision);
  const Matrix3d R = site.R_ecef_enu();
  const Matrix3d C = R.transpose() * precision->covariance_ecef * R;
  EXPECT_NEAR(std::sqrt(C(1, 1)), std::sqrt(2.0) * D * D / b * sigma, 1e-3);
  EXPECT_NEAR(std::sqrt(C(0, 0)), D * sigma / std::sqrt(2.0), 1e-5);
}

TEST(CramerRao, NothingWithoutTwoRaysThatCross) {
  const LocalFrame site(kSite);
  const PlannedTarget target{site.to_ecef({0, 500, 0})};
  EXPECT_FALSE(position_precision({}, target));
  const auto one = station_at(site, {0, 0, 0});
  EXPECT_FALSE(position_precision(std::vector{one}, target));
  EXPECT_FALSE(position_precision(std::vector{one, one}, target));
}

TEST(CramerRao, OneMoreStationNeverHurts) {
  const LocalFrame site(kSite);
  auto stations = four(site);
  const PlannedTarget target{site.to_ecef({150, 220, 90})};
  const Matrix3d less = position_precision(std::span(stations).first(3), target)->covariance_ecef;
  const Matrix3d more = position_precision(stations, target)->covariance_ecef;
  // A station says nothing along its own ray: one eigenvalue is zero but for rounding.
  const auto gains = Eigen::SelfAdjointEigenSolver<Matrix3d>(less - more).eigenvalues().eval();
  EXPECT_GT(gains.minCoeff(), -1e-12 * less.norm());
  EXPECT_GT(gains.maxCoeff(), 0.0);
}

TEST(CramerRao, ScalingTheSceneScalesTheErrorAlone) {
  const LocalFrame site(kSite);
  const auto at = [&](double scale) {
    std::vector<PlannedStation> stations = {station_at(site, scale * Vector3d(-30, 0, 0)),
                                            station_at(site, scale * Vector3d(30, 10, 1)),
                                            station_at(site, scale * Vector3d(5, 40, 3))};
    return enu_at(site.origin_ecef(),
                  position_precision(stations, {site.to_ecef(scale * Vector3d(10, 20, 15))})
                      ->covariance_ecef);
  };
  EXPECT_TRUE(near(at(20.0), 400.0 * at(1.0), 1e-3 * at(20.0).trace()));
}

// What the plan says of a calibration is what sight() says of it on the optical axis.
TEST(SourceCovariance, CalibrationIsThatOfSight) {
  StationGeometry geometry;
  geometry.position = kSite;
  geometry.chain.heading_rad = 0.3;
  geometry.sd = {3e-3, 2e-3, 1e-3, 5e-3, 0.0};
  const LocalFrame ground(kSite);
  for (const Vector3d& p_enu : {Vector3d(300, 400, 20), Vector3d(100, -50, 300)}) {
    const Vector3d p = ground.to_ecef(p_enu);
    PixelSight measurement;
    measurement.pixel = {geometry.camera.cx_px, geometry.camera.cy_px};
    measurement.angles = aim_at(geometry, p).value();
    const LineOfSight line = sight(geometry, measurement).value();
    const PlannedStation plan{LocalFrame(geodetic_from_ecef(line.origin_ecef)), 0.0, geometry.sd,
                              0.0};
    EXPECT_TRUE(
        near(bearing_precision(plan, {p}).covariance_rad2, line.covariance_systematic, 1e-9));
  }
}

TEST(SourceCovariance, ClockIsWorthTheMotionInItsError) {
  const LocalFrame site(kSite);
  PlannedStation station{site, 0.0, {}, 0.01};
  const Vector3d v = site.R_ecef_enu() * Vector3d(30, 0, 0);  // across the sight line
  const PlannedTarget target{site.to_ecef({0, 300, 0}), v * v.transpose()};
  const auto R = source_covariance(station, ErrorSource::kClock, target);
  EXPECT_NEAR(std::sqrt(R(0, 0)), 0.01 * 30.0 / 300.0, 1e-9);
  EXPECT_NEAR(R(1, 1), 0.0, 1e-12);
}

TEST(PositionPrecision, PartsSumToTheWholeAndOnlyTheWhiteOneAverages) {
  const LocalFrame site(kSite);
  auto stations = four(site);
  for (auto& station : stations) {
    station.calibration = {1e-3, 5e-4, 2e-4, 1e-3, 0.05};
    station.clock_sd_s = 0.01;
  }
  const PlannedTarget target{site.to_ecef({150, 220, 90}), 25.0 * Matrix3d::Identity()};
  const auto one = position_precision(stations, target);
  ASSERT_TRUE(one);
  Matrix3d sum = Matrix3d::Zero();
  for (const Matrix3d& part : one->parts_ecef) sum += part;
  EXPECT_TRUE(near(sum, one->covariance_ecef, 1e-9));
  const auto many = position_precision(stations, target, 1e9);
  EXPECT_LT(many->parts_ecef[0].trace(), 1e-8 * one->parts_ecef[0].trace());
  EXPECT_GT(many->covariance_ecef.trace(), 0.9 * one->covariance_ecef.trace());
}

}  // namespace
}  // namespace ols
