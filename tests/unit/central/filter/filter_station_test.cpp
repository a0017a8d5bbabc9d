#include "central/filter/filter_station.h"

#include <gtest/gtest.h>

#include "geometry/wgs84.h"
#include "tests/unit/central/scene.h"

namespace ols::fusion {
namespace {

constexpr std::int64_t kNow = 1'600'000'000'000'000;

BearingMeasurement bearing(double declared_rad = 0.0) {
  Ray ray = test::ray_to("a", {0.0, 0.0, 0.0}, {0.0, 300.0, 50.0});
  ray.sight.covariance_systematic = declared_rad * declared_rad * Eigen::Matrix2d::Identity();
  return test::measurement_of(ray, kNow);
}

FilterStation used_at(std::int64_t utime_us, double declared_rad = 0.0) {
  BearingMeasurement measurement = bearing(declared_rad);
  measurement.utime_us = utime_us;
  FilterStation station;
  station.note_use(measurement, 2.0, 1.0);
  return station;
}

TEST(FilterStation, RemembersTheBearingThatWasUsed) {
  FilterStation station;
  station.rejected = 3;
  const BearingMeasurement measurement = bearing();
  station.note_use(measurement, 12.0, 0.75);
  EXPECT_EQ(station.used, 1);
  EXPECT_EQ(station.rejected, 0);
  EXPECT_EQ(station.weight, 0.75);
  EXPECT_EQ(station.last_used.last_us, kNow);
  EXPECT_DOUBLE_EQ(station.mean_nis, 2.5);  // a twentieth of the way from 2 to 12
  EXPECT_TRUE(station.R_ecef_enu.isApprox(R_ecef_enu(measurement.sight.origin_ecef)));
}

TEST(FilterStation, TwoThatDeclareNothingCannotTellTheirErrors) {
  const std::vector<FilterStation> two = {used_at(kNow), used_at(kNow)};
  EXPECT_FALSE(is_redundant(two, two.front()));
}

TEST(FilterStation, AThirdOneTells) {
  const std::vector<FilterStation> three = {used_at(kNow), used_at(kNow), used_at(kNow)};
  EXPECT_TRUE(is_redundant(three, three.front()));
}

TEST(FilterStation, AThirdOneThatHasFallenSilentDoesNot) {
  const std::vector<FilterStation> three = {used_at(kNow), used_at(kNow),
                                            used_at(kNow - 60'000'000)};
  EXPECT_FALSE(is_redundant(three, three.front()));
}

TEST(FilterStation, WhatIsDeclaredIsAlwaysEstimated) {
  const std::vector<FilterStation> two = {used_at(kNow, 1e-3), used_at(kNow)};
  EXPECT_TRUE(is_redundant(two, two.front()));
  EXPECT_FALSE(is_redundant(two, two.back()));
}

}  // namespace
}  // namespace ols::fusion
