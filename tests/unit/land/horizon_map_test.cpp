// Against lands with exact answers.
#include "land/horizon_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "land/lowest_visible.h"
#include "tests/unit/error_text.h"
#include "tests/unit/land/made_land.h"

namespace ols::land {
namespace {

constexpr double kHorizon_rad = 0.02e-3;
const Geodetic kCamera{radians(38.5), radians(-28.4), 30.0};
const LocalFrame kFrame(kCamera);
const double kColumn_rad = 2.0 * kPi / 7200;

// Four columns beside an azimuth.
HorizonMap look(const Surface& land, double azimuth_rad, const Geodetic& camera = kCamera) {
  return {land,
          camera,
          {.from_azimuth_rad = azimuth_rad - 2.0 * kColumn_rad, .sector_rad = 4.0 * kColumn_rad}};
}

double cell_m(double distance_m) { return std::max(1.0, kColumn_rad * distance_m); }

// Metres north of the camera, on the ellipsoid's meridian.
double north_m(double latitude_rad) {
  constexpr double a = 6'378'137.0, e2 = 0.00669437999014;
  const double s = std::sin(kCamera.latitude_rad);
  return (latitude_rad - kCamera.latitude_rad) * a * (1.0 - e2) / std::pow(1.0 - e2 * s * s, 1.5);
}

const MadeLand kSphere([](double, double) { return 0.0; });
// The crest is 400 m high, 5 km north of the camera, with sides of 1:4.
const MadeLand kRidge([](double latitude_rad, double) {
  return std::max(0.0, 400.0 - 0.25 * std::abs(north_m(latitude_rad) - 5000.0));
});
// 12 m deep and 40 m high, 2 km north of the camera, and level land everywhere.
const MadeLand kWall([](double latitude_rad, double) {
  const double behind_m = north_m(latitude_rad) - 2000.0;
  return behind_m >= 0.0 && behind_m < 12.0 ? 40.0 : 0.0;
});
// The tip is 700 m high, 8 km away; sides of 1:2.
const Geodetic kTip = place_at(kFrame, 700 * kColumn_rad, 8000.0, 700.0);
const LocalFrame kTipFrame({kTip.latitude_rad, kTip.longitude_rad, 0.0});
double cone(double latitude_rad, double longitude_rad) {
  const auto enu = kTipFrame.to_enu(ecef_from_geodetic({latitude_rad, longitude_rad, 0.0}));
  return std::max(0.0, 700.0 - 0.5 * enu.head<2>().norm());
}
const MadeLand kCone(cone);

// The highest apparent elevation along an azimuth, by dense and exact samples up to a distance.
double highest(const Surface& land, double azimuth_rad, double from_m, double to_m) {
  double highest_rad = -1.0;
  for (double d = from_m; d <= to_m; d += 0.2) {
    Geodetic place = place_at(kFrame, azimuth_rad, d, 0.0);
    place.height_m = land.top(place.latitude_rad, place.longitude_rad)->height_m;
    highest_rad = std::max(highest_rad, see(kFrame, place).direction.elevation_rad);
  }
  return highest_rad;
}

TEST(HorizonMap, SeesTheDipOfTheSphere) {
  for (const double height_m : {3.0, 30.0, 45.0}) {
    const Geodetic camera{kCamera.latitude_rad, kCamera.longitude_rad, height_m};
    for (const double azimuth_rad : {0.0, 1.0, 2.34567, 4.0, 6.283}) {
      constexpr double a = 6'378'137.0, e2 = 0.00669437999014;
      const double w = 1.0 - e2 * std::pow(std::sin(kCamera.latitude_rad), 2);
      const double c = std::cos(azimuth_rad), s = std::sin(azimuth_rad);
      const double N = a / std::sqrt(w), M = N * (1.0 - e2) / w;
      const double curvature = c * c / M + s * s / N - 0.13 / 6'371'000.0;  // the ray is bent, too
      EXPECT_NEAR(look(kSphere, azimuth_rad, camera).skyline(azimuth_rad)->elevation_rad,
                  -std::sqrt(2.0 * height_m * curvature), 0.1 * kHorizon_rad);
    }
  }
}

TEST(HorizonMap, SeesCrestsTipsAndWalls) {
  const auto tip = see(kFrame, kTip).direction;
  EXPECT_NEAR(look(kCone, tip.azimuth_rad).skyline(tip.azimuth_rad)->elevation_rad,
              tip.elevation_rad, kHorizon_rad);
  for (const double columns : {-150.3, -60.5, -7.7, 3.5, 44.4, 140.0}) {
    const double azimuth_rad = tip.azimuth_rad + columns * kColumn_rad;
    EXPECT_NEAR(look(kCone, azimuth_rad).skyline(azimuth_rad)->elevation_rad,
                highest(kCone, azimuth_rad, 6400.0, 8200.0), kHorizon_rad)
        << columns;
  }
  struct Case {
    const Surface& land;
    double azimuth_rad, from_m, to_m;
  };
  for (const Case& one : {Case{kRidge, 0.0, 4900.0, 5100.0}, Case{kRidge, 0.61803, 5900.0, 6300.0},
                          Case{kWall, 0.0, 1990.0, 2020.0}, Case{kWall, -0.4242, 2100.0, 2250.0}}) {
    const auto skyline = look(one.land, one.azimuth_rad).skyline(one.azimuth_rad);
    EXPECT_NEAR(skyline->elevation_rad, highest(one.land, one.azimuth_rad, one.from_m, one.to_m),
                kHorizon_rad);
    EXPECT_NEAR(skyline->distance_m, 0.5 * (one.from_m + one.to_m), 150.0);
  }
}

TEST(HorizonMap, FindsTheRangeOfTheGroundToACell) {
  struct Case {
    const Surface& land;
    std::vector<double> distances_m;
    double azimuth_rad;
  };
  const std::vector<Case> cases{{kSphere, {3.0, 40.0, 333.0, 2000.0, 9000.0, 15'000.0}, 0.7777},
                                {kRidge, {100.0, 2500.0, 3500.0, 4321.0, 4960.0}, 0.1234},
                                {kCone, {2000.0, 6700.0, 7200.0, 7700.0}, 700.4 * kColumn_rad},
                                {kWall, {5.5, 1500.0, 1995.0}, 0.0}};
  for (const Case& one : cases) {
    const HorizonMap map = look(one.land, one.azimuth_rad);
    for (const double distance_m : one.distances_m) {
      Geodetic place = place_at(kFrame, one.azimuth_rad, distance_m, 0.0);
      place.height_m = one.land.top(place.latitude_rad, place.longitude_rad)->height_m;
      const Seen seen = see(kFrame, place);
      const auto hit = map.ground(seen.direction);
      ASSERT_TRUE(hit) << distance_m;
      EXPECT_NEAR(hit->range_m / seen.range_m * distance_m, distance_m, cell_m(distance_m));
    }
  }
  const HorizonMap wall = look(kWall, 0.0);
  EXPECT_NEAR(wall.ground({0.0, radians(0.0)})->range_m, 2000.0, cell_m(2000.0));  // on its front
  EXPECT_FALSE(wall.ground({0.0, radians(0.4)}));
}

TEST(HorizonMap, FindsTheGroundAtTheCamerasFoot) {
  for (const double high_m : {1.7, 30.0}) {
    const Geodetic camera{kCamera.latitude_rad, kCamera.longitude_rad, high_m};
    const HorizonMap map = look(kSphere, 1.0, camera);
    for (const double down_deg : {50.0, 61.0, 75.0, 88.0, 89.9}) {
      const double down = radians(down_deg);
      const auto hit = map.ground({1.0, -down});
      ASSERT_TRUE(hit) << high_m << ' ' << down_deg;
      const double range_m = high_m / std::sin(down), distance_m = high_m / std::tan(down);
      EXPECT_NEAR(hit->range_m, range_m, 0.02 * range_m) << down_deg;
      EXPECT_NEAR(hit->rise_rad_per_m * range_m * distance_m / high_m, 1.0, 0.2) << down_deg;
    }
  }
}

TEST(HorizonMap, TellsHowFastTheGroundRisesAlongALineOfSight) {
  const HorizonMap map = look(kRidge, 0.0);
  const auto hit = map.ground({0.0, radians(2.0)});  // on the side of 1:4
  const double up_m = 0.25, d = hit->range_m;
  EXPECT_NEAR(hit->rise_rad_per_m, (up_m - std::tan(radians(2.0))) / d, 0.02 / d);
}

TEST(HorizonMap, VisibilityFollowsThePointsCovariance) {
  const HorizonMap map = look(kWall, 0.0);
  const double top_rad = map.skyline(0.0)->elevation_rad;
  const auto behind = [&](double above_rad, double distance_m) {
    return kFrame.to_ecef({0.0, distance_m,
                           distance_m * std::tan(top_rad + above_rad) -
                               0.13 * distance_m * distance_m / (2.0 * 6'371'000.0)});
  };
  const Eigen::Matrix3d exact = Eigen::Matrix3d::Zero();
  EXPECT_NEAR(map.visible_probability(behind(1e-4, 4000.0), exact), 1.0, 1e-6);
  EXPECT_NEAR(map.visible_probability(behind(-1e-4, 4000.0), exact), 0.0, 1e-6);
  EXPECT_NEAR(map.visible_probability(behind(-1e-4, 1990.0), exact), 1.0, 1e-6);  // before the wall
  // 2 m of height at 4 km are 0.5 mrad.
  const Eigen::Matrix3d R = kFrame.R_ecef_enu();
  const Eigen::Matrix3d vertical = R * Eigen::Vector3d(0.0, 0.0, 4.0).asDiagonal() * R.transpose();
  EXPECT_NEAR(map.visible_probability(behind(0.5e-3, 4000.0), vertical), 0.841, 0.01);
  EXPECT_NEAR(map.visible_probability(behind(-0.5e-3, 4000.0), vertical), 0.159, 0.01);
  // Half of where it may be is before the wall.
  const Eigen::Matrix3d along = R * Eigen::Vector3d(0.0, 1e4, 0.0).asDiagonal() * R.transpose();
  const double half = map.visible_probability(behind(-5e-3, 2000.0), along);
  EXPECT_GT(half, 0.35);
  EXPECT_LT(half, 0.65);
}

// Level land with a wood at 3.9 km, whose height is hardly known, and a crest at 4 km, which is
// surely a little higher.
class WoodBeforeCrest : public Surface {
 public:
  std::optional<SurfaceHeight> ground(double latitude_rad, double) const override {
    const double at_m = north_m(latitude_rad);
    if (at_m > 3900.0 && at_m < 3910.0) return SurfaceHeight{50.0, 60.0};
    if (at_m > 4000.0 && at_m < 4010.0) return SurfaceHeight{60.0, 0.0};
    return SurfaceHeight{0.0, 0.0};
  }
  std::optional<SurfaceHeight> top(double latitude_rad, double longitude_rad) const override {
    return ground(latitude_rad, longitude_rad);
  }
};

TEST(HorizonMap, AnUnsureWoodBetweenTheDistancesOfAPointIsNotOverlooked) {
  const HorizonMap map = look(WoodBeforeCrest(), 0.0);
  const Eigen::Vector3d place(0.0, 3950.0, 70.0);  // clearly above the crest, not above the wood
  const Eigen::Vector3d towards = place.normalized();
  const double sd_m = 100.0;
  const Eigen::Matrix3d R = kFrame.R_ecef_enu();
  const Eigen::Matrix3d along = R * (sd_m * sd_m * towards * towards.transpose()) * R.transpose();
  double mean = 0.0;
  for (const double sigmas : {-1.39981, -0.53190, 0.0, 0.53190, 1.39981}) {
    const Eigen::Vector3d at = kFrame.to_ecef(place + sigmas * sd_m * towards);
    mean += 0.2 * map.visible_probability(at, Eigen::Matrix3d::Zero());
  }
  EXPECT_LT(mean, 0.99);
  EXPECT_NEAR(map.visible_probability(kFrame.to_ecef(place), along), mean, 2e-3);
}

TEST(HorizonMap, TheSurfacesErrorIsThatOfTheSkyline) {
  const MadeLand rough([](double, double) { return 0.0; }, 4.0);
  const HorizonMap map = look(rough, 1.0);
  const Skyline near = *map.highest_before(1.0, 1000.0);
  EXPECT_NEAR(near.elevation_sd_rad, 4.0e-3, 0.05e-3);
  const double d = map.skyline(1.0)->distance_m;  // 0.1 of k is 0.16 mrad at 20 km
  EXPECT_NEAR(map.skyline(1.0)->elevation_sd_rad, std::hypot(4.0 / d, 0.05 * d / 6'371'000.0),
              1e-5);
}

TEST(HorizonMap, GapsHideNothingAndAreTold) {
  const MadeLand with_gap([](double latitude_rad, double) -> std::optional<double> {
    const double m = north_m(latitude_rad);
    if (m > 3000.0 && m < 4000.0) return std::nullopt;
    return m < 3500.0 ? 0.0 : 60.0;
  });
  const HorizonMap map = look(with_gap, 0.0);
  EXPECT_NEAR(map.known_to_m(0.0), 3000.0, 2.0 * cell_m(3000.0));
  EXPECT_EQ(look(with_gap, kPi).known_to_m(kPi), 30'000.0);
  EXPECT_FALSE(map.skyline(kPi));  // where it did not look
  EXPECT_NEAR(map.ground({0.0, radians(0.0)})->range_m, 4000.0, 2.0 * cell_m(4000.0));
}

TEST(HorizonMap, ACameraUnderTheGroundIsRefusedOrWithinItsError) {
  const auto level = [](double height_m, double sd_m) {
    return MadeLand([=](double, double) { return height_m; }, sd_m);
  };
  const auto text = [](const Surface& land) {
    return error_text<std::invalid_argument>([&] { look(land, 1.0); });
  };
  EXPECT_NE(text(level(85.0, 4.0)).find("55 m under the ground"), std::string::npos);
  EXPECT_NE(text(MadeLand([](double, double) {
              return std::optional<double>();
            })).find("does not know the ground at the camera"),
            std::string::npos);
  const MadeLand too_high = level(34.0, 4.0);
  const HorizonMap map = look(too_high, 1.0);  // 4 m under it: that is the model's error
  EXPECT_DOUBLE_EQ(map.lowered_m(), 5.0);
  EXPECT_LT(map.skyline(1.0)->elevation_rad, radians(2.0));
}

// Tree-tops above the camera up to 50 m away: it stands at their edge.
class Grove : public MadeLand {
 public:
  Grove() : MadeLand([](double, double) { return 25.0; }) {}
  std::optional<SurfaceHeight> top(double latitude_rad, double) const override {
    const double m = std::abs(north_m(latitude_rad));
    return SurfaceHeight{m < 50.0 || (m > 500.0 && m < 600.0) ? 45.0 : 25.0, 0.0};
  }
};

TEST(HorizonMap, WhatCoversTheCameraHidesNothing) {
  const auto skyline = look(Grove(), 0.0).skyline(0.0);
  EXPECT_NEAR(skyline->elevation_rad, 15.0 / 500.0, 1e-3);
  EXPECT_NEAR(skyline->distance_m, 500.0, 2.0);
}

// Against what is hidden below and not above.
TEST(LowestVisible, IsTheHeightOfTheLineOverTheCrest) {
  const HorizonMap map = look(kRidge, 0.0);
  for (const double distance_m : {500.0, 4500.0, 5500.0, 7000.0, 12'000.0}) {
    const Geodetic place = place_at(kFrame, 0.0, distance_m, 0.0);
    const double ground_m = kRidge.ground(place.latitude_rad, place.longitude_rad)->height_m;
    const double before_m = std::min(distance_m, 5000.0);
    const double highest_rad = highest(kRidge, 0.0, std::max(2.0, before_m - 200.0), before_m);
    const double lowest_m = lowest_visible_m(map, place.latitude_rad, place.longitude_rad).value();
    EXPECT_GT(lowest_m, ground_m - 0.5) << distance_m;
    Geodetic seen = place;
    seen.height_m = lowest_m;
    EXPECT_NEAR(see(kFrame, seen).direction.elevation_rad, highest_rad, 2.0 * kHorizon_rad)
        << distance_m;
  }
}

TEST(LowestVisible, IsNotKnownBehindAGap) {
  const MadeLand land([](double latitude_rad, double) {
    return std::abs(north_m(latitude_rad) - 3000.0) < 100.0 ? std::nullopt : std::optional(0.0);
  });
  const HorizonMap map = look(land, 0.0);
  const auto at = [&](double distance_m) {
    const Geodetic place = place_at(kFrame, 0.0, distance_m, 0.0);
    return lowest_visible_m(map, place.latitude_rad, place.longitude_rad);
  };
  EXPECT_TRUE(at(2500.0));
  EXPECT_FALSE(at(3500.0));
}

}  // namespace
}  // namespace ols::land
