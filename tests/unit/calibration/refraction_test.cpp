#include "calibration/refraction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/angles.h"

namespace ols::calibration {
namespace {

TEST(Refraction, LiftsAPlaceOnTheGroundByHalfOfTheSquaredDistanceOverTheRadius) {
  const Eigen::Vector3d lift = terrestrial_lift_m({0.0, 10000.0, 0.0});
  EXPECT_NEAR(lift.z(), 1e8 / (2.0 * 6371000.0), 1e-9);
  EXPECT_NEAR(lift.head<2>().norm(), 0.0, 1e-9);
}

TEST(Refraction, ActsAcrossTheLineOfSightAndLessTowardsThinAir) {
  const Eigen::Vector3d high(3000.0, 4000.0, 5000.0);
  const Eigen::Vector3d lift = terrestrial_lift_m(high);
  EXPECT_NEAR(lift.dot(high.normalized()), 0.0, 1e-9);
  EXPECT_GT(lift.z(), 0.0);
  EXPECT_LT(lift.norm(), 0.9 * high.squaredNorm() / (2.0 * 6371000.0));
}

TEST(Refraction, OfTheSkyIsThatOfBennettsFormula) {
  const AstronomicalRefraction refraction({.pressure_hPa = 1010.0, .temperature_degC = 10.0});
  for (const double seen_deg : {20.0, 45.0, 70.0}) {
    const double bennett_rad =
        1.0 / std::tan(radians(seen_deg + 7.31 / (seen_deg + 4.4))) * kPi / 10800.0;
    const double zenith_rad = kPi / 2.0 - radians(seen_deg) + bennett_rad;
    // Made for sea level and all of the sky, it is 3 % more than the theory high up.
    EXPECT_NEAR(refraction.lift_rad(zenith_rad), bennett_rad, 0.035 * bennett_rad) << seen_deg;
  }
  EXPECT_NEAR(refraction.lift_rad(0.0), 0.0, 1e-12);
}

TEST(Refraction, KnowsTheStandardAtmosphere) {
  EXPECT_NEAR(standard_air(0.0).pressure_hPa, 1013.25, 1e-9);
  EXPECT_NEAR(standard_air(1000.0).pressure_hPa, 898.8, 0.1);
  EXPECT_NEAR(standard_air(1000.0).temperature_degC, 8.5, 1e-9);
}

TEST(Refraction, APressureReducedToSeaLevelIsNoPressureOfAMountain) {
  EXPECT_EQ(pressure_trouble(1013.25, 1500.0),
            "1013.2 hPa cannot be the pressure at 1500 m, where it is about 846 hPa: it looks "
            "reduced to sea level, as weather services state it; at the station that is 845.6 hPa");
  EXPECT_EQ(pressure_trouble(700.0, 300.0),
            "700.0 hPa cannot be the pressure at 300 m, where it is about 978 hPa");
  for (const double weather_hPa : {-69.0, 0.0, 69.0}) {
    EXPECT_EQ(pressure_trouble(845.6 + weather_hPa, 1500.0), "");
  }
  for (const double no_weather_hPa : {-71.0, 71.0}) {
    EXPECT_NE(pressure_trouble(845.6 + no_weather_hPa, 1500.0), "");
  }
}

}  // namespace
}  // namespace ols::calibration
