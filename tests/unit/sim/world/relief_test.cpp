#include "sim/world/relief.h"

#include <gtest/gtest.h>

#include "sim/world/land_model.h"

namespace ols::sim {
namespace {

// A hill of 40 m in the middle, a house north of it, a tree south of it.
ReliefScenario made() {
  ReliefScenario scenario;
  scenario.roughness_m = 0.0;
  scenario.hills.push_back({{0.0, 0.0}, 40.0, {30.0, 30.0}});
  scenario.houses.push_back({{0.0, 300.0}, {20.0, 10.0, 8.0}, 0.0});
  scenario.trees.push_back({{0.0, -300.0}, 12.0, 3.0});
  return scenario;
}

TEST(Relief, HidesWhatIsBehindIt) {
  struct Case {
    const char* what;
    Eigen::Vector3d from, to;
    bool hidden;
  };
  const Case cases[] = {
      {"behind the hill", {-300.0, 0.0, 2.0}, {300.0, 0.0, 20.0}, true},
      {"beside it", {-300.0, 150.0, 2.0}, {300.0, 150.0, 20.0}, false},
      {"just above its top", {-300.0, 0.0, 2.0}, {300.0, 0.0, 78.5}, false},
      {"just below", {-300.0, 0.0, 2.0}, {300.0, 0.0, 77.5}, true},
      {"before it", {-300.0, 0.0, 2.0}, {-100.0, 0.0, 20.0}, false},
      {"behind the house", {-50.0, 309.0, 2.0}, {200.0, 309.0, 10.0}, true},
      {"beside it, along its length", {-50.0, 311.0, 2.0}, {200.0, 311.0, 10.0}, false},
      {"behind the tree", {-50.0, -300.0, 2.0}, {200.0, -300.0, 30.0}, true},
      {"beside it", {-50.0, -303.5, 2.0}, {200.0, -303.5, 30.0}, false},
  };
  const Relief relief(made());
  for (const Case& c : cases) {
    SCOPED_TRACE(c.what);
    EXPECT_EQ(relief.hides(c.from, c.to), c.hidden);
    const Eigen::Vector2d over = (c.to - c.from).head<2>();
    const double slope = (c.to.z() - c.from.z()) / over.norm();
    EXPECT_EQ(relief.highest_slope(c.from, over.normalized(), over.norm()) > slope, c.hidden);
  }
}

TEST(Relief, IsSurveyedWithTheErrorsThatAreStated) {
  ReliefScenario scenario = made();
  scenario.model.reach_m = 600.0;
  const LocalFrame site({0.86, 0.29, 310.0});
  const Relief relief(scenario);
  double sum_m2 = 0.0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto terrain = survey(scenario, site, seed).terrain();
    for (double at_m = -500.0; at_m <= 500.0; at_m += 100.0) {
      const Eigen::Vector2d place_m(at_m, 0.5 * at_m);
      const Geodetic place = geodetic_from_ecef(site.to_ecef({place_m.x(), place_m.y(), 0.0}));
      const auto ground = terrain->ground(place.latitude_rad, place.longitude_rad);
      ASSERT_TRUE(ground);
      EXPECT_EQ(ground->sd_m, scenario.model.sd_m);
      sum_m2 += std::pow(ground->height_m - 310.0 - relief.ground_m(place_m), 2);
      ++count;
    }
    const Geodetic house = geodetic_from_ecef(site.to_ecef({0.0, 300.0, 0.0}));
    EXPECT_NEAR(terrain->top(house.latitude_rad, house.longitude_rad)->height_m, 318.0, 5.0);
    const Geodetic tree = geodetic_from_ecef(site.to_ecef({0.0, -300.0, 0.0}));
    EXPECT_NEAR(terrain->top(tree.latitude_rad, tree.longitude_rad)->height_m, 310.0, 5.0);
  }
  EXPECT_NEAR(sum_m2 / count, 1.0, 0.25);
}

}  // namespace
}  // namespace ols::sim
