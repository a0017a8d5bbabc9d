#include "central/ground/seen_skylines.h"

#include <gtest/gtest.h>

#include "geometry/angles.h"
#include "tests/unit/central/ground/lands.h"

namespace ols::fusion {
namespace {

constexpr double kHigh_rad = 0.05, kFrom_m = 500.0, kTargetSd_m = 2.0;
const Land kFlat(flat);

// An obstacle in the east.
SkylineSector obstacle() {
  SkylineSector sector{
      .station = "a", .begun_us = 5, .camera_ecef = kFlat.at(0.0, 0.0, 10.0), .sector = 18};
  for (int column = 1780; column < 1820; ++column) {
    sector.columns.push_back({column, {kHigh_rad, 1e-4, kFrom_m, true}});
  }
  return sector;
}

double visibility(const SeenSkylines& skylines, double distance_m, double elevation_rad,
                  double moved_m = 0.0) {
  const Eigen::Vector3d p_ecef =
      kFlat.at(distance_m, 0.0, 10.0 + distance_m * std::tan(elevation_rad));
  return skylines.visibility("a", kFlat.at(moved_m, 0.0, 10.0), p_ecef,
                             enu_covariance(p_ecef, {kTargetSd_m, kTargetSd_m, kTargetSd_m}));
}

TEST(SeenSkylines, WhatIsBehindAndBelowIsHidden) {
  SeenSkylines skylines;
  EXPECT_EQ(visibility(skylines, 1000.0, 0.0), 1.0);
  SkylineSector sector = obstacle();
  for (const int number : {17, 18}) {  // 90 degrees are where two sectors meet
    sector.sector = number;
    skylines.take(sector);
  }
  EXPECT_LT(visibility(skylines, 1000.0, 0.02), 1e-6);
  EXPECT_GT(visibility(skylines, 1000.0, 0.08), 1.0 - 1e-6);
  EXPECT_EQ(visibility(skylines, 490.0, 0.02), 1.0) << "in front of it";
  // At its edge, by the target's sigma.
  EXPECT_NEAR(visibility(skylines, 1000.0, kHigh_rad), 0.5, 0.05);
  EXPECT_NEAR(visibility(skylines, 1000.0, kHigh_rad + kTargetSd_m / 1000.0), 0.84, 0.05);
}

TEST(SeenSkylines, CountOnlyFromTheirPlaceAndWithATrustedHeading) {
  SeenSkylines skylines;
  SkylineSector sector = obstacle();
  skylines.take(sector);
  const Eigen::Vector3d camera_ecef = sector.camera_ecef;
  EXPECT_NE(skylines.of("a", camera_ecef), nullptr);
  EXPECT_EQ(skylines.of("b", camera_ecef), nullptr);
  EXPECT_EQ(skylines.of("a", kFlat.at(6.0, 0.0, 10.0)), nullptr);
  sector.heading_disagrees = true;
  skylines.take(sector);
  EXPECT_EQ(skylines.of("a", camera_ecef), nullptr);
  sector.heading_disagrees = false;
  skylines.take(sector);
  EXPECT_NE(skylines.of("a", camera_ecef), nullptr);
  skylines.forget("a");
  EXPECT_EQ(skylines.of("a", camera_ecef), nullptr);
}

TEST(SeenSkylines, AnotherSkylineBeginsAnew) {
  SeenSkylines skylines;
  SkylineSector sector = obstacle();
  skylines.take(sector);
  SkylineSector other = sector;
  other.sector = 30;
  other.columns = {{3000, {0.1, 1e-4, 10.0, true}}};
  skylines.take(other);
  EXPECT_EQ(skylines.of("a", sector.camera_ecef)->count(), 21);
  other.begun_us = 6;
  skylines.take(other);
  EXPECT_EQ(skylines.of("a", sector.camera_ecef)->count(), 1);
  skylines.take({.station = "a"});  // nothing is seen any more
  EXPECT_EQ(skylines.of("a", sector.camera_ecef), nullptr);
}

}  // namespace
}  // namespace ols::fusion
