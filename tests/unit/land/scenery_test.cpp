// Ranges from two panoramas of walls at known places.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "geometry/angles.h"
#include "land/refraction.h"
#include "land/scenery/epipolar_search.h"
#include "land/scenery/patch_fit.h"
#include "land/scenery/possible_ranges.h"
#include "land/scenery/scene_panorama.h"
#include "land/scenery/scenery_ranges.h"
#include "tests/unit/land/made_land.h"

namespace ols::scenery {
namespace {

const Geodetic kMiddle{radians(38.5), radians(-28.5), 100.0};
constexpr double kBaseline_m = 200.0;
const PoseSd kSd{radians(0.005), radians(0.005), 0.05};

// A wall across the view to the north, painted at random.
struct Wall {
  double north_m, west_m, east_m, top_m, spot_m;

  double gray(double east, double up, std::uint32_t paint) const {
    const double u = east / spot_m, v = up / spot_m;
    const double a = u - std::floor(u), b = v - std::floor(v);
    const auto spot = [&](int i, int j) {
      const auto x = static_cast<std::uint32_t>(std::floor(u) + i + 5000);
      const auto y = static_cast<std::uint32_t>(std::floor(v) + j + 5000);
      std::uint32_t mixed = (x * 0x8da6b343U) ^ (y * 0xd8163841U) ^ (paint * 0xcb1ab31fU);
      mixed = (mixed ^ (mixed >> 13)) * 0x5bd1e995U;
      return 60.0 + (mixed >> 8) % 120;
    };
    return (1 - b) * ((1 - a) * spot(0, 0) + a * spot(1, 0)) +
           b * ((1 - a) * spot(0, 1) + a * spot(1, 1));
  }
};
constexpr std::array kWalls{Wall{1000.0, -50.0, 50.0, 25.0, 1.3},
                            Wall{2000.0, -400.0, 400.0, 80.0, 2.6}};

ScenePanorama panorama_at(double east_m, double first_azimuth_rad, std::uint32_t paint) {
  const LocalFrame frame(kMiddle);
  ScenePanorama panorama{.gray = cv::Mat1b(200, 800),
                         .first_azimuth_rad = first_azimuth_rad,
                         .top_elevation_rad = 0.05,
                         .rad_per_px = 3e-4,
                         .centre_ecef = frame.to_ecef({east_m, 0.0, 0.0}),
                         .R_ecef_enu = frame.R_ecef_enu(),
                         .sd = kSd};
  for (int j = 0; j < panorama.gray.rows; ++j) {
    for (int i = 0; i < panorama.gray.cols; ++i) {
      double gray = 220.0;
      for (const Wall& wall : kWalls) {
        AzimuthElevation direction = direction_of(panorama, Eigen::Vector2d(i, j));
        direction.elevation_rad -= land::refraction_slope(land::kRefraction, wall.north_m);
        const Eigen::Vector3d ray = enu_from_azimuth_elevation(direction);
        const double range_m = wall.north_m / ray.y();
        const double east = east_m + range_m * ray.x(), up = range_m * ray.z();
        if (east < wall.west_m || east > wall.east_m || up > wall.top_m) continue;
        // Each wall has its own painting.
        gray = wall.gray(east, up, 2 * paint + (wall.north_m > 1500.0 ? 1 : 0));
        break;
      }
      panorama.gray(j, i) = static_cast<std::uint8_t>(gray);
    }
  }
  return panorama;
}
ScenePanorama left() { return panorama_at(-0.5 * kBaseline_m, -0.04, 1); }
ScenePanorama right(std::uint32_t paint = 1) {
  return panorama_at(0.5 * kBaseline_m, -0.20, paint);
}

std::optional<RangeInterval> anywhere(const AzimuthElevation& /*direction*/) {
  return RangeInterval{500.0, 4000.0};
}

TEST(ScenePanorama, TheRangeOfAPointIsThatAtWhichBothSeeIt) {
  const ScenePanorama one = left(), two = right();
  const Eigen::Vector3d p_ecef = LocalFrame(kMiddle).to_ecef({30.0, 1500.0, 20.0});
  const ScenePixel in_one = pixel_of(one, p_ecef), in_two = pixel_of(two, p_ecef);
  EXPECT_NEAR((point_ecef(one, in_one.px, in_one.range_m) - p_ecef).norm(), 0.0, 1e-3);
  const auto found_m = range_m(one, two, in_one.px, in_two.px.x(), 900.0);
  ASSERT_TRUE(found_m);
  EXPECT_NEAR(*found_m, in_one.range_m, 1e-3);
}

// Far away, an error of the parallax angle is R^2 / B of it.
TEST(ScenePanorama, TheSigmaOfARangeComesFromBothHeadingsAndBothPositions) {
  ScenePanorama one = left(), two = right();
  const Eigen::Vector3d p_ecef = LocalFrame(kMiddle).to_ecef({0.0, 3000.0, 20.0});
  const ScenePixel in_one = pixel_of(one, p_ecef), in_two = pixel_of(two, p_ecef);
  const auto sd_m = [&] { return range_sd_m(one, two, in_one.px, in_two.px.x(), in_one.range_m); };
  const double per_rad_m = 3000.0 * 3000.0 / kBaseline_m;
  one.sd = two.sd = {.heading_rad = kSd.heading_rad};
  EXPECT_NEAR(sd_m(), std::sqrt(2.0) * kSd.heading_rad * per_rad_m, 0.01 * sd_m());
  one.sd = two.sd = {.position_m = 0.05};
  EXPECT_NEAR(sd_m(), std::sqrt(2.0) * 0.05 / 3000.0 * per_rad_m, 0.01 * sd_m());
}

TEST(SceneryRanges, WallsAreFoundWithinTheirSigmasThoughThePosesErr) {
  const ScenePanorama one = with_error(left(), {.heading_rad = radians(0.006),
                                                .tilt_rad = {radians(-0.008), radians(0.005)},
                                                .position_enu_m = {0.04, 0.0, -0.06}});
  const auto ranges = scenery_ranges(one, right(), anywhere, anywhere);
  const ScenePanorama exact_one = left(), exact_two = right();
  std::array<int, 2> found{};
  std::vector<double> white_sigmas;
  int wrong = 0;
  for (const SceneryRange& range : ranges) {
    const auto exact_m = range_m(exact_one, exact_two, range.px, range.other_px.x(), range.range_m);
    ASSERT_TRUE(exact_m);
    const Eigen::Vector3d p_enu =
        LocalFrame(kMiddle).to_enu(point_ecef(exact_one, range.px, *exact_m));
    const std::size_t wall = p_enu.y() < 1500.0 ? 0 : 1;
    ++found[wall];
    const double truth_m = *exact_m * kWalls[wall].north_m / p_enu.y();
    wrong += std::abs(range.range_m - truth_m) > 4.0 * range.sd_m() ? 1 : 0;
    white_sigmas.push_back(std::abs(*exact_m - truth_m) / range.sd_white_m);
    EXPECT_LT(range.sd_m(), 0.01 * truth_m);
  }
  EXPECT_GE(found[0], 20);
  EXPECT_GE(found[1], 20);
  EXPECT_EQ(wrong, 0);
  std::ranges::sort(white_sigmas);
  EXPECT_LT(white_sigmas[white_sigmas.size() / 2], 1.0);
}

TEST(PatchFit, AnEdgeDecidesWhereAPatchIsFound) {
  cv::Mat1f image(40, 40, 100.0F);
  image.colRange(0, 24) = 180.0F;
  const Eigen::Vector2d off = deciding_offset(image, {20.0, 20.0}, 0.0);
  EXPECT_NEAR(20.0 + off.x(), 23.5, 1.0);
}

TEST(EpipolarSearch, AWindowHasItsLikeBesideIt) {
  ScenePanorama houses{.gray = cv::Mat1b(60, 240, std::uint8_t{160})};
  for (int x = 10; x < 240; x += 40) houses.gray(cv::Rect(x, 20, 14, 18)) = 40;
  const ScenePyramid pyramid = pyramid_of(houses, 1);
  const Eigen::Vector2d corner(90.0, 20.0);
  EXPECT_GT(likest_beside(pyramid, 0, corner, 0.0, 45.0), 0.99);
  EXPECT_LT(likest_beside(pyramid, 0, corner, 0.0, 20.0), 0.8);
}

// The same walls, painted anew: nothing in one picture is in the other.
TEST(SceneryRanges, WhatOnlyLooksAlikeIsNotMatched) {
  EXPECT_TRUE(scenery_ranges(left(), right(2), anywhere, anywhere).empty());
}

TEST(PossibleRanges, SomethingStandsWhereTheLineIsNearTheGround) {
  const land::MadeLand level([](double, double) { return 0.0; }, 1.0);
  const AzimuthElevation down{0.0, radians(-1.0)};
  const auto range = [&](double height_m) {
    const LocalFrame camera(Geodetic{kMiddle.latitude_rad, kMiddle.longitude_rad, height_m});
    return possible_ranges(level, camera, down, {300.0, 8000.0});
  };
  const double slope = std::tan(radians(1.0));
  const auto low = range(20.0), high = range(100.0);
  ASSERT_TRUE(low && high);
  EXPECT_NEAR(low->near_m, 300.0, 1.0);
  EXPECT_NEAR(low->far_m, 23.0 / slope, 30.0);
  EXPECT_NEAR(high->near_m, 70.0 / slope, 150.0);
  EXPECT_NEAR(high->far_m, 103.0 / slope, 250.0);
  EXPECT_FALSE(range(300.0));
}

}  // namespace
}  // namespace ols::scenery
