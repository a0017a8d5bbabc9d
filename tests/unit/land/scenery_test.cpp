// Ranges from two panoramas of walls at known places.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "geometry/angles.h"
#include "land/refraction.h"
#include "land/scenery/epipolar_search.h"
#include "land/scenery/patch_fit.h"
#include "land/scenery/picture_panorama.h"
#include "land/scenery/possible_ranges.h"
#include "land/scenery/scene_panorama.h"
#include "land/scenery/scenery_ranges.h"
#include "tests/unit/land/made_land.h"
#include "tests/unit/land/painted_walls.h"

namespace ols::scenery {
namespace {

constexpr double kBaseline_m = 200.0;
const PoseSd kSd{radians(0.005), radians(0.005), 0.05};

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
      const AzimuthElevation direction = direction_of(panorama, Eigen::Vector2d(i, j));
      panorama.gray(j, i) = painted_gray(east_m, direction, paint);
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

// A picture whose axis points to this azimuth, level, that shows a gray value which grows with
// azimuth and elevation.
double gray_towards(const AzimuthElevation& direction) {
  return 100.0 + 200.0 * wrap_pi(direction.azimuth_rad) + 100.0 * direction.elevation_rad;
}
ScenePicture sloping_picture(double azimuth_rad, double brighter = 0.0) {
  CameraIntrinsics camera;
  camera.width_px = 640;
  camera.height_px = 480;
  camera.fx_px = camera.fy_px = 2000.0;
  camera.cx_px = 320.0;
  camera.cy_px = 240.0;
  camera.k1 = 0.05;
  ScenePicture picture{.gray = cv::Mat1b(480, 640), .camera = camera};
  const Eigen::Vector3d forward = enu_from_azimuth_elevation({azimuth_rad, 0.0});
  const Eigen::Vector3d down(0.0, 0.0, -1.0);
  picture.R_enu_camera << down.cross(forward), down, forward;
  for (int y = 0; y < picture.gray.rows; ++y) {
    for (int x = 0; x < picture.gray.cols; ++x) {
      const Eigen::Vector3d ray = *unproject(camera, {x, y});
      picture.gray(y, x) = static_cast<std::uint8_t>(std::lround(
          brighter + gray_towards(azimuth_elevation_from_enu(picture.R_enu_camera * ray))));
    }
  }
  return picture;
}

TEST(PicturePanorama, ShowsEachDirectionAsThePictureWhoseAxisIsNearestShowsIt) {
  const std::vector<ScenePicture> pictures{sloping_picture(0.0), sloping_picture(0.2, 40.0)};
  ScenePanorama panorama{.rad_per_px = 1e-3};
  draw(pictures, {wrap_two_pi(-0.3), 0.7, -0.1, 0.1}, panorama);
  EXPECT_EQ(panorama.gray.cols, 700);
  EXPECT_EQ(panorama.gray.rows, 200);
  const auto off = [&](int x, int y) {
    return panorama.gray(y, x) - gray_towards(direction_of(panorama, Eigen::Vector2d(x, y)));
  };
  for (const int y : {20, 100, 180}) {
    for (const int x : {160, 300, 395}) EXPECT_NEAR(off(x, y), 0.0, 1.1) << x << ' ' << y;
    for (const int x : {405, 500, 640}) EXPECT_NEAR(off(x, y), 40.0, 1.1) << x << ' ' << y;
    for (const int x : {100, 690}) EXPECT_EQ(panorama.gray(y, x), kUnseen) << x;
  }
}

// The lower half of a panorama without pictures has an edge to the upper one that is no scenery.
TEST(SceneryRanges, TheEdgeOfThePicturesIsNoScenery) {
  ScenePanorama one = left(), two = right();
  for (ScenePanorama* cut : {&one, &two}) cut->gray.rowRange(120, 200) = kUnseen;
  const auto ranges = scenery_ranges(one, two, anywhere, anywhere);
  EXPECT_GE(ranges.size(), 20U);
  for (const SceneryRange& range : ranges) EXPECT_LT(range.px.y(), 111.0);
}

TEST(PicturePanorama, BothBoxesShowWhatCanStandThere) {
  const LocalFrame camera(kMiddle);
  const LocalFrame other(geodetic_from_ecef(camera.to_ecef({500.0, 0.0, 0.0})));
  // Something stands only between 1 and 2 km, above the horizon.
  const auto possible = [](const AzimuthElevation& to) -> std::optional<RangeInterval> {
    if (to.elevation_rad < 0.0) return std::nullopt;
    return RangeInterval{1000.0, 2000.0};
  };
  const SceneBox sector{radians(350.0), radians(20.0), radians(-2.0), radians(3.0)};
  const auto boxes = shared_boxes(sector, camera, other, possible);
  ASSERT_TRUE(boxes);
  EXPECT_NEAR(boxes->own.bottom_rad, 0.0, radians(0.2));
  EXPECT_EQ(boxes->own.top_rad, sector.top_rad);
  // Leftmost: 10 degrees to the left at 1 km; rightmost: 10 degrees to the right at 2 km.
  const auto azimuth = [](double azimuth_rad, double range_m) {
    return std::atan2(range_m * std::sin(azimuth_rad) - 500.0, range_m * std::cos(azimuth_rad));
  };
  const double left_rad = azimuth(radians(-10.0), 1000.0), right_rad = azimuth(radians(10.0), 2e3);
  EXPECT_NEAR(wrap_pi(boxes->other.first_azimuth_rad - left_rad), 0.0, radians(0.2));
  EXPECT_NEAR(boxes->other.width_rad, right_rad - left_rad, radians(0.4));
  EXPECT_FALSE(shared_boxes(sector, camera, other, [](const auto&) { return std::nullopt; }));
  // 1 km away, two stations 3 km apart see two different sides.
  const LocalFrame far(geodetic_from_ecef(camera.to_ecef({3000.0, 0.0, 0.0})));
  const auto near = [](const AzimuthElevation&) { return RangeInterval{900.0, 1000.0}; };
  EXPECT_FALSE(shared_boxes(sector, camera, far, near));
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
