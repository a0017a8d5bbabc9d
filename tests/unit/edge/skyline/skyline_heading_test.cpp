#include "edge/skyline/skyline_heading.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/unit/edge/skyline/made_site.h"

namespace ols::skyline {
namespace {

const StationSd kStation{.place_enu_m = Eigen::Vector3d::Constant(kModelSd_m)};

struct Maps {
  explicit Maps(unsigned seed)
      : site(seed),
        truth(site.truth(), site.camera(), quick_map()),
        model(site.model(), site.camera(), quick_map()) {}
  MadeSite site;
  land::HorizonMap truth, model;
};

// A picture of a part of the true skyline, by a station whose heading is wrong by `wrong_rad`.
std::vector<SkylinePoint> picture(const land::HorizonMap& truth, double from_deg, double to_deg,
                                  double wrong_rad, unsigned seed) {
  constexpr double kNoise_rad = 1e-4;
  std::mt19937 generator(seed);
  std::normal_distribution<double> noise(0.0, kNoise_rad);
  std::vector<SkylinePoint> points;
  for (double deg = from_deg; deg < to_deg; deg += 0.03) {
    const auto skyline = truth.skyline(radians(deg));
    if (!skyline) continue;
    points.push_back(
        {{wrap_two_pi(radians(deg) + wrong_rad), skyline->elevation_rad + noise(generator)},
         kNoise_rad});
  }
  return points;
}

SkylineHeading heading_by(const SeenHorizon& seen, const Maps& maps) {
  return skyline_heading(seen.places(), maps.model, kStation).value();
}

TEST(SkylineHeadingTest, WholeHorizonGivesTheErrorWithAnHonestSigma) {
  constexpr int kSites = 6;
  double nees = 0.0;
  for (unsigned seed = 1; seed <= kSites; ++seed) {
    const Maps maps(seed);
    const double wrong_rad = radians(seed % 2 == 0 ? 0.1 : -0.4);
    SeenHorizon seen;
    seen.add(picture(maps.truth, 0.0, 360.0, wrong_rad, seed), 0.0, 0.0);
    const SkylineHeading heading = heading_by(seen, maps);
    EXPECT_LT(std::abs(heading.error_rad - wrong_rad), 4.0 * heading.sd_rad) << "seed " << seed;
    EXPECT_LT(heading.sd_rad, radians(0.045)) << "seed " << seed;
    nees += std::pow((heading.error_rad - wrong_rad) / heading.sd_rad, 2) / kSites;
  }
  // 98 of 100 right sigmas would be between these.
  EXPECT_GT(nees, 0.15);
  EXPECT_LT(nees, 2.8);
}

TEST(SkylineHeadingTest, ManyPicturesOfOneCrestSayLittleMoreThanOne) {
  const Maps maps(3);
  SeenHorizon once, often, around;
  once.add(picture(maps.truth, 40.0, 60.0, 0.0, 1), 0.0, 0.0);
  for (unsigned i = 0; i < 100; ++i) often.add(picture(maps.truth, 40.0, 60.0, 0.0, i), i, 0.0);
  around.add(picture(maps.truth, 0.0, 360.0, 0.0, 1), 0.0, 0.0);
  const double once_rad = heading_by(once, maps).sd_rad, often_rad = heading_by(often, maps).sd_rad;
  EXPECT_GT(often_rad, 0.6 * once_rad);
  EXPECT_LT(heading_by(around, maps).sd_rad, 0.5 * often_rad);
}

TEST(SkylineHeadingTest, TreesAndHousesBeforeTheSkylineCountLittle) {
  const Maps maps(5);
  SeenHorizon with, without;
  auto points = picture(maps.truth, 0.0, 360.0, radians(0.1), 1);
  without.add(points, 0.0, 0.0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i % 400 < 40) points[i].direction.elevation_rad += radians(2.0);
  }
  with.add(points, 0.0, 0.0);
  const SkylineHeading heading = heading_by(with, maps);
  EXPECT_NEAR(heading.error_rad, heading_by(without, maps).error_rad, radians(0.03));
  EXPECT_LT(std::abs(heading.error_rad - radians(0.1)), 4.0 * heading.sd_rad);
}

TEST(SkylineHeadingTest, ATiltOfTheStationIsNoHeading) {
  const Maps maps(7);
  SeenHorizon seen;
  auto points = picture(maps.truth, 0.0, 360.0, 0.0, 1);
  for (auto& point : points) {
    point.direction.elevation_rad +=
        radians(0.3) * std::sin(point.direction.azimuth_rad) - radians(0.2);
  }
  seen.add(points, 0.0, 0.0);
  const SkylineHeading heading = heading_by(seen, maps);
  EXPECT_LT(std::abs(heading.error_rad), 4.0 * heading.sd_rad);
}

TEST(SkylineHeadingTest, NothingIsSaidOfAFewPlaces) {
  const Maps maps(9);
  SeenHorizon seen;
  seen.add(picture(maps.truth, 10.0, 12.0, 0.0, 1), 0.0, 0.0);
  EXPECT_FALSE(skyline_heading(seen.places(), maps.model, kStation).has_value());
}

}  // namespace
}  // namespace ols::skyline
