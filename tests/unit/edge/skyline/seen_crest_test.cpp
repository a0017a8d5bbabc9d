#include "edge/skyline/seen_crest.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/angles.h"
#include "tests/unit/land/made_land.h"

namespace ols::skyline {
namespace {

constexpr double kRidgeSd_m = 4.0, kCrest_m = 2000.0, kHigh_m = 100.0;
constexpr double kElevationSd_rad = 1e-4;

// Level ground 10 m below the camera, and a ridge across the north.
class SeenCrestTest : public ::testing::Test {
 protected:
  static land::MadeLand ridge() {
    return land::MadeLand(
        [](double lat, double) {
          const double north_m = (lat - kCamera.latitude_rad) * 6.37e6;
          return std::max(0.0, kHigh_m - 0.2 * std::abs(north_m - kCrest_m));
        },
        kRidgeSd_m);
  }
  static std::optional<land::SeenCrest> seen(double elevation_rad, double azimuth_rad = 0.0) {
    static const land::MadeLand kRidge = ridge();
    static const land::HorizonMap kMap(kRidge, kCamera, {.columns = 720, .reach_m = 5000.0});
    SeenPlace place;
    place.direction = {azimuth_rad, elevation_rad};
    place.variance_rad2 = 1e-10;
    place.azimuth_variance_rad2 = std::pow(1e-4, 2);
    return seen_crest(place, kElevationSd_rad, kMap);
  }
  static inline const Geodetic kCamera{radians(46.0), radians(9.0), 10.0};
  static inline const double kSkyline_rad = std::atan((kHigh_m - 10.0) / kCrest_m);
};

TEST_F(SeenCrestTest, WhatAgreesIsFusedByItsErrors) {
  const double model_sd_rad = kRidgeSd_m / kCrest_m;
  const double off_rad = 2.0 * model_sd_rad;  // trees, within the model's error
  const auto crest = seen(kSkyline_rad + off_rad);
  ASSERT_TRUE(crest);
  EXPECT_FALSE(crest->disagrees);
  const double share = 1.0 / (1.0 + std::pow(kElevationSd_rad / model_sd_rad, 2));
  EXPECT_NEAR(crest->elevation_rad, kSkyline_rad + share * off_rad, 2e-4);
  EXPECT_NEAR(crest->sd_rad, std::sqrt(share) * kElevationSd_rad, 2e-5);
  EXPECT_NEAR(crest->hides_from_m, kCrest_m, 20.0);
}

TEST_F(SeenCrestTest, TreesOnTheCrestHideWhatIsBeyondTheCrest) {
  const auto crest = seen(kSkyline_rad + 25.0 / kCrest_m);
  EXPECT_TRUE(crest->disagrees);
  EXPECT_NEAR(crest->elevation_rad, kSkyline_rad + 25.0 / kCrest_m, 1e-9);
  EXPECT_NEAR(crest->hides_from_m, kCrest_m, 20.0);
}

// 0.1 rad above a camera that is 10 m above the ground: 30 m reach so high from 200 m.
TEST_F(SeenCrestTest, WhatIsTooHighForTheCrestStandsNearer) {
  const auto crest = seen(0.1);
  EXPECT_TRUE(crest->disagrees);
  EXPECT_GT(crest->hides_from_m, 0.9 * 200.0);
  EXPECT_LT(crest->hides_from_m, 200.0);
}

TEST_F(SeenCrestTest, WhatHazeMayConcealIsNotTakenAway) {
  const auto crest = seen(kSkyline_rad - 20.0 / kCrest_m);
  EXPECT_TRUE(crest->disagrees);
  EXPECT_EQ(crest->hides_from_m, 0.0);
}

TEST_F(SeenCrestTest, AnErrorOfTheHeadingCountsOnASlope) {
  SeenPlace place;
  place.direction = {0.0, 0.045 + 0.02};
  place.variance_rad2 = 1e-10;
  const land::MadeLand slope([](double lat, double lon) {
    const double north_m = (lat - kCamera.latitude_rad) * 6.37e6;
    const double east_m = (lon - kCamera.longitude_rad) * 6.37e6 * std::cos(kCamera.latitude_rad);
    return north_m > kCrest_m ? 100.0 + 1.0 * east_m : 0.0;
  });
  const land::HorizonMap map(slope, kCamera, {.columns = 720, .reach_m = 2500.0});
  EXPECT_TRUE(seen_crest(place, kElevationSd_rad, map)->disagrees);
  place.azimuth_variance_rad2 = std::pow(0.01, 2);
  const auto crest = seen_crest(place, kElevationSd_rad, map);
  EXPECT_FALSE(crest->disagrees);
}

TEST_F(SeenCrestTest, WhereTheMapKnowsNothingThereIsNone) {
  const land::MadeLand gap([](double lat, double) {
    return lat > kCamera.latitude_rad ? std::nullopt : std::optional(0.0);
  });
  const land::HorizonMap map(gap, kCamera, {.columns = 720, .reach_m = 2500.0});
  SeenPlace place;
  place.variance_rad2 = 1e-10;
  EXPECT_FALSE(seen_crest(place, kElevationSd_rad, map));
}

}  // namespace
}  // namespace ols::skyline
