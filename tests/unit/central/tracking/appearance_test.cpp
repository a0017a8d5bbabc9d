#include "central/tracking/appearance.h"

#include <gtest/gtest.h>

#include "tests/unit/central/scene.h"

namespace ols::fusion {
namespace {

const Eigen::Vector3d kObject(0.0, 300.0, 80.0), kVelocity(3.0, -2.0, 4.0);

// What a station sees of an object with this velocity, 0.5 m large.
BearingMeasurement seen_from(const Eigen::Vector3d& p_enu,
                             const Eigen::Vector3d& v_enu = kVelocity) {
  constexpr double kStepS = 0.01;
  BearingMeasurement m = test::measurement_of(test::ray_to("a", p_enu, kObject), 1);
  const auto at = [&](double t) {
    return test::direction_to(m.sight.origin_ecef, test::site().to_ecef(kObject + t * v_enu));
  };
  const AzimuthElevation from = at(-kStepS), to = at(kStepS);
  m.sighted.rate_rad_s =
      Eigen::Vector2d((to.azimuth_rad - from.azimuth_rad) * std::cos(from.elevation_rad),
                      to.elevation_rad - from.elevation_rad) /
      (2.0 * kStepS);
  m.sighted.rate_covariance = 1e-6 * Eigen::Matrix2d::Identity();
  const double range_m = (kObject - p_enu).norm();
  m.sighted.size_rad = 0.5 / range_m;
  m.sighted.size_sd_rad = 1e-4;
  m.sighted.signal = 1e6 / (range_m * range_m);
  return m;
}

const Eigen::Vector3d kA(-300.0, 10.0, 0.0), kB(100.0, 0.0, 20.0);

bool are_one(const BearingMeasurement& a, const BearingMeasurement& b) {
  const Eigen::Vector3d normal =
      (b.sight.origin_ecef - a.sight.origin_ecef).cross(direction_ecef(a.sight)).normalized();
  return may_be_one(a, (kObject - kA).norm(), b, (kObject - kB).norm(), normal);
}

TEST(Appearance, OfOneObjectAgrees) { EXPECT_TRUE(are_one(seen_from(kA), seen_from(kB))); }

TEST(Appearance, TwoThatLeaveThePlaneDifferentlyAreTwo) {
  EXPECT_FALSE(are_one(seen_from(kA), seen_from(kB, {3.0, -2.0, -4.0})));
}

TEST(Appearance, ASizeOrBrightnessFarFromTheOtherIsOfAnother) {
  const BearingMeasurement a = seen_from(kA);
  BearingMeasurement b = seen_from(kB);
  b.sighted.size_rad *= 8.0;
  EXPECT_FALSE(are_one(a, b));
  b = seen_from(kB);
  b.sighted.signal *= 40.0;
  EXPECT_FALSE(are_one(a, b));
  b.sighted.signal = 0.0;
  EXPECT_TRUE(are_one(a, b)) << "unknown";
}

TEST(Appearance, TheRateOfATargetIsItsVelocityAcross) {
  KinematicState state;
  state.mean.setZero();
  state.mean.head<3>() = test::site().to_ecef(kObject);
  state.mean.segment<3>(3) = test::site().to_ecef(kObject + kVelocity) - state.mean.head<3>();
  state.covariance = 0.01 * Eigen::Matrix<double, 9, 9>::Identity();
  EXPECT_LT(rate_nis(seen_from(kA), state), 0.01);
  EXPECT_GT(rate_nis(seen_from(kA, {3.0, -2.0, -20.0}), state), 25.0);
  BearingMeasurement without = seen_from(kA, {3.0, -2.0, -20.0});
  without.sighted = {};
  EXPECT_EQ(rate_nis(without, state), 0.0);
}

}  // namespace
}  // namespace ols::fusion
