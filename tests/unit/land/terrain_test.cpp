#include "land/terrain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "geometry/angles.h"

namespace ols::land {
namespace {

constexpr float kVoid = std::numeric_limits<float>::quiet_NaN();

// Steps of a thousandth of a degree, from 38.5 N, `west_deg` E.
HeightGrid grid_of(const std::vector<float>& heights_m, int columns, double west_deg = 10.0,
                   double sd_m = 4.0) {
  return {radians(38.5),
          radians(west_deg),
          radians(0.001),
          radians(0.001),
          static_cast<int>(heights_m.size()) / columns,
          columns,
          sd_m,
          heights_m};
}

std::optional<SurfaceHeight> ground(const Surface& land, double south_steps, double east_steps,
                                    double west_deg = 10.0) {
  return land.ground(radians(38.5 - 0.001 * south_steps), radians(west_deg + 0.001 * east_steps));
}

TEST(Terrain, IsBilinearAndUnknownWhereAHeightIsMissing) {
  const std::vector<float> heights{0,  10, 20, 30,  //
                                   40, 50, 60, kVoid};
  const Terrain land({grid_of(heights, 4)}, {}, nullptr);
  EXPECT_NEAR(ground(land, 0.0, 0.0)->height_m, 0.0, 1e-6);
  EXPECT_NEAR(ground(land, 0.5, 0.5)->height_m, 25.0, 1e-6);
  EXPECT_NEAR(ground(land, 1.0, 1.75)->height_m, 57.5, 1e-6);
  EXPECT_NEAR(ground(land, 0.25, 0.0)->height_m, 10.0, 1e-6);
  EXPECT_EQ(ground(land, 0.25, 1.0)->sd_m, 4.0);
  EXPECT_FALSE(ground(land, 0.5, 2.5));
  for (const auto& [south, east] :
       {std::pair(-0.01, 1.0), {1.01, 1.0}, {0.5, -0.01}, {0.5, 3.01}}) {
    EXPECT_FALSE(ground(land, south, east));
  }
}

TEST(Terrain, TheFirstGridThatKnowsAPlaceCounts) {
  const std::vector<float> fine{1, kVoid, 1, kVoid}, coarse{7, 7, 7, 7};
  const Terrain land({grid_of(fine, 2, 10.0, 1.0), grid_of(coarse, 2)}, {}, nullptr);
  EXPECT_EQ(ground(land, 0.5, 0.5)->height_m, 7.0);
  const std::vector<float> all{1, 1, 1, 1};
  const Terrain known({grid_of(all, 2, 10.0, 1.0), grid_of(coarse, 2)}, {}, nullptr);
  EXPECT_EQ(ground(known, 0.5, 0.5)->height_m, 1.0);
  EXPECT_EQ(ground(known, 0.5, 0.5)->sd_m, 1.0);
}

TEST(Terrain, ReachesBeyond180Degrees) {
  const std::vector<float> heights{5, 5, 5, 5, 5, 5};
  const Terrain land({grid_of(heights, 3, 179.999)}, {}, nullptr);
  EXPECT_TRUE(ground(land, 0.5, 0.5, 179.999));
  EXPECT_TRUE(land.ground(radians(38.4995), radians(-179.9995)));
}

std::vector<Eigen::Vector2d> corners(const std::vector<std::pair<double, double>>& east_south) {
  std::vector<Eigen::Vector2d> ring;
  for (const auto& [east, south] : east_south) {
    ring.emplace_back(radians(10.0 + 0.001 * east), radians(38.5 - 0.001 * south));
  }
  return ring;
}

TEST(Terrain, RoofsAreLevelAndTreeTopsFollowTheGround) {
  const std::vector<float> heights{0, 100, 0, 100};  // rises to the east
  const Covering house{
      CoveringKind::kBuilding, {corners({{.2, .2}, {.4, .2}, {.4, .4}, {.2, .4}})}, 9.0, 3.0};
  const Covering wood{CoveringKind::kWood,
                      {corners({{.5, .1}, {.9, .1}, {.9, .9}, {.5, .9}}),
                       corners({{.6, .4}, {.7, .4}, {.7, .5}, {.6, .5}})},
                      25.0,
                      5.0};
  const Terrain land({grid_of(heights, 2)}, {house, wood}, nullptr);
  const auto top = [&](double south, double east) {
    return *land.top(radians(38.5 - 0.001 * south), radians(10.0 + 0.001 * east));
  };
  EXPECT_NEAR(top(0.3, 0.21).height_m, 29.0, 1e-5);
  EXPECT_NEAR(top(0.3, 0.30).height_m, 30.0, 1e-5);  // the slope has passed the roof
  EXPECT_NEAR(top(0.3, 0.21).sd_m, 5.0, 1e-9);
  EXPECT_NEAR(top(0.3, 0.55).height_m, 80.0, 1e-5);
  EXPECT_NEAR(top(0.45, 0.65).height_m, 65.0, 1e-5);  // a clearing
  EXPECT_NEAR(top(0.95, 0.65).height_m, 65.0, 1e-5);
}

// Long outlines over many cells: against the rule of odd crossings on the whole polygon.
TEST(Terrain, APlaceIsInsideAsTheWholeOutlineSays) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> anywhere(0.0, 30.0);
  std::vector<std::pair<double, double>> star;
  for (int i = 0; i < 400; ++i) {
    const double radius = 8.0 + 0.4 * anywhere(random) * (i % 2), angle = 2.0 * kPi * i / 400;
    star.emplace_back(15.0 + radius * 0.7 * std::cos(angle), 15.0 + 0.7 * radius * std::sin(angle));
  }
  const Covering wood{
      CoveringKind::kWood, {corners(star), corners({{1, 1}, {6, 2}, {3, 7}})}, 1.0, 0.0};
  const CoveringIndex index({wood});
  int wrong = 0, inside = 0;
  for (int i = 0; i < 5000; ++i) {
    const Eigen::Vector2d at = corners({{anywhere(random), anywhere(random)}})[0];
    bool expected = false, found = false;
    for (const auto& ring : wood.rings) {
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const auto &a = ring[k], &b = ring[(k + 1) % ring.size()];
        const bool passes = (a.y() <= at.y()) != (b.y() <= at.y());
        if (passes && a.x() + (at.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()) > at.x()) {
          expected = !expected;
        }
      }
    }
    index.for_each_at(at, [&](std::uint32_t) { found = true; });
    wrong += found != expected;
    inside += found;
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(inside, 500);
}

}  // namespace
}  // namespace ols::land
