#include "geometry/placement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "geometry/angles.h"

namespace ols {
namespace {

using Eigen::Vector3d;

const LocalFrame kSite({radians(49.2), radians(16.6), 300.0});
constexpr int kPlaces = 60;

PlannedStation place_at(const Vector3d& p_enu) {
  return {LocalFrame(geodetic_from_ecef(kSite.to_ecef(p_enu))), 1e-4, {}, 0.0};
}

// A disc to protect, 300 m in radius and 80 m high.
std::vector<PlannedTarget> disc() {
  std::vector<PlannedTarget> area;
  for (double x = -300; x <= 300; x += 60) {
    for (double y = -300; y <= 300; y += 60) {
      if (std::hypot(x, y) <= 300.0) area.push_back({kSite.to_ecef({x, y, 80.0})});
    }
  }
  return area;
}

// Places on circles around its centre, the same angles on each.
PlacementProblem around_the_disc(std::size_t stations, const std::vector<double>& radii = {300}) {
  PlacementProblem problem;
  for (const double radius : radii) {
    for (int i = 0; i < kPlaces; ++i) {
      const double angle = 2.0 * kPi * i / kPlaces;
      problem.places.push_back(place_at({radius * std::cos(angle), radius * std::sin(angle), 0}));
    }
  }
  problem.area = disc();
  problem.stations = stations;
  return problem;
}

class RegularPolygon : public testing::TestWithParam<std::size_t> {};

// "The tracking stations should be positioned so as to form approximately regular polygon."
TEST_P(RegularPolygon, ComesOutWhereNothingPreventsIt) {
  std::mt19937_64 generator(3);
  PlacementProblem problem = around_the_disc(GetParam(), {300, 400});
  problem.starts = 12;
  const Placement placement = place_stations(problem, generator);
  ASSERT_EQ(placement.chosen.size(), GetParam());
  const int even = kPlaces / static_cast<int>(GetParam());
  for (std::size_t i = 0; i < placement.chosen.size(); ++i) {
    EXPECT_LT(placement.chosen[i], std::size_t{kPlaces});  // on the edge of the area
    const std::size_t next = placement.chosen[(i + 1) % placement.chosen.size()];
    const int gap =
        (static_cast<int>(next) - static_cast<int>(placement.chosen[i]) + kPlaces) % kPlaces;
    EXPECT_NEAR(gap, even, 1) << "after place " << placement.chosen[i];
  }
}
INSTANTIATE_TEST_SUITE_P(Placement, RegularPolygon, testing::Values(3, 4, 5, 6));

// Somewhere around or in the disc, each with a wall that hides a sector of up to half a turn.
PlacementProblem behind_walls(std::mt19937_64& random, std::size_t places, std::size_t stations) {
  PlacementProblem problem;
  std::uniform_real_distribution<double> east_m(-500.0, 500.0), angle(0.0, kPi);
  for (std::size_t i = 0; i < places; ++i) {
    PlannedStation place = place_at({east_m(random), east_m(random), 0.0});
    const double from = 2.0 * angle(random), width = angle(random);
    place.sees = [frame = place.place, from, width](const Vector3d& p_ecef) {
      const Vector3d enu = frame.to_enu(p_ecef);
      return wrap_two_pi(std::atan2(enu.x(), enu.y()) - from) > width;
    };
    problem.places.push_back(place);
  }
  problem.area = disc();
  problem.stations = stations;
  return problem;
}

TEST(Placement, IsAsGoodAsTheBestOfAllChoices) {
  std::mt19937_64 random(5);
  for (int run = 0; run < 20; ++run) {
    PlacementProblem problem = behind_walls(random, 14, 3);
    for (const PlacementGoal goal : {PlacementGoal::kMean, PlacementGoal::kWorst}) {
      problem.goal = goal;
      const auto cost = [&](const Placement& p) {
        return std::pair(p.undetermined, goal == PlacementGoal::kMean ? p.mean_m : p.worst_m);
      };
      auto least = cost(rate_placement(problem, {0, 1, 2}));
      for (std::size_t a = 0; a < 14; ++a) {
        for (std::size_t b = a + 1; b < 14; ++b) {
          for (std::size_t c = b + 1; c < 14; ++c) {
            least = std::min(least, cost(rate_placement(problem, {a, b, c})));
          }
        }
      }
      const auto found = cost(place_stations(problem, random));
      EXPECT_EQ(found.first, least.first) << run;
      EXPECT_LE(found.second, 1.02 * least.second) << run;
    }
  }
}

// What the land hides from a station, it tells nothing of.
TEST(Placement, PointsThatFewerThanTwoSeeAreCounted) {
  PlacementProblem problem = around_the_disc(2);
  problem.places = {problem.places[0], problem.places[15]};
  problem.places[1].sees = [](const Vector3d& p_ecef) { return kSite.to_enu(p_ecef).x() > 1.0; };
  const Placement placement = rate_placement(problem, {0, 1});
  std::size_t west = 0;
  for (const PlannedTarget& target : problem.area) {
    west += kSite.to_enu(target.p_ecef).x() > 1.0 ? 0 : 1;
  }
  EXPECT_EQ(placement.undetermined, west);
  EXPECT_LT(placement.worst_m, 1.0);
  EXPECT_FALSE(placement.determines_all());
  problem.within_m = 0.9 * placement.worst_m;
  const Placement nearer = rate_placement(problem, {0, 1});
  EXPECT_GT(nearer.undetermined, west);
  EXPECT_LE(nearer.worst_m, problem.within_m);
  const PlannedTarget& hidden = problem.area.front();
  EXPECT_FALSE(position_precision(problem.places, hidden));
  problem.places[1].sees = {};
  EXPECT_TRUE(position_precision(problem.places, hidden));
}

TEST(Placement, AStationThatStandsIsNotDoubled) {
  PlacementProblem problem = around_the_disc(2);
  problem.kept = {problem.places[0]};
  std::mt19937_64 generator(3);
  const Placement placement = place_stations(problem, generator);
  // With the one that stands they are the triangle again.
  EXPECT_NEAR(static_cast<double>(placement.chosen[0]), 20.0, 1.0);
  EXPECT_NEAR(static_cast<double>(placement.chosen[1]), 40.0, 1.0);
}

// A station tells nothing of its own place, and all of the others.
TEST(Placement, APlaceMayBeWhatIsToBeProtected) {
  std::mt19937_64 generator(3);
  PlacementProblem problem = around_the_disc(3);
  for (const double x : {-300.0, 0.0, 300.0}) {
    problem.places.push_back(place_at({x, 0.0, 80.0}));  // points of the area
  }
  for (const PlacementGoal goal : {PlacementGoal::kMean, PlacementGoal::kWorst}) {
    problem.goal = goal;
    const Placement placement = place_stations(problem, generator);
    EXPECT_EQ(placement.chosen.size(), 3U);
    EXPECT_TRUE(placement.determines_all());
  }
  const Placement among = rate_placement(problem, {kPlaces, kPlaces + 1, kPlaces + 2});
  EXPECT_GT(among.mean_m, 0.0);
  EXPECT_TRUE(std::isfinite(among.worst_m));
  problem.kept = {problem.places.back()};
  EXPECT_EQ(place_stations(problem, generator).chosen.size(), 3U);
}

// What one ray leaves open is not closed by rounding, however sure the ray is.
TEST(Placement, ASureRayHasNoDepthEither) {
  for (const double white_rad : {1e-5, 1e-6, 1e-8}) {
    PlacementProblem problem = around_the_disc(1);
    for (PlannedStation& place : problem.places) place.white_rad = white_rad;
    for (const PlacementGoal goal : {PlacementGoal::kMean, PlacementGoal::kWorst}) {
      problem.goal = goal;
      std::mt19937_64 generator(3);
      const Placement placement = place_stations(problem, generator);
      EXPECT_EQ(placement.chosen.size(), 1U) << white_rad;
      EXPECT_FALSE(placement.determines_all()) << white_rad;
      EXPECT_GT(placement.mean_m, 1e5) << white_rad;
    }
  }
}

// Two stations that stand in the area leave their own places out, and see all others.
TEST(Placement, TwoOfTheAreasOwnPointsProtectTheRest) {
  PlacementProblem problem = around_the_disc(2);
  problem.places.clear();
  for (const auto& [x, y] : {std::pair(-300.0, 0.0), {300.0, 0.0}, {0.0, 300.0}, {0.0, 0.0}}) {
    problem.places.push_back(place_at({x, y, 80.0}));
  }
  std::mt19937_64 generator(3);
  const Placement placement = place_stations(problem, generator);
  EXPECT_EQ(placement.chosen.size(), 2U);
  EXPECT_GT(placement.mean_m, 0.0);
}

TEST(Placement, OneStationAloneIsAnAnswerToo) {
  std::mt19937_64 generator(3);
  const Placement placement = place_stations(around_the_disc(1), generator);
  EXPECT_EQ(placement.chosen.size(), 1U);
  EXPECT_GT(placement.mean_m, 1e5);  // a ray has no depth
  EXPECT_FALSE(placement.determines_all());
}

TEST(Placement, RefusesWhatHasNoAnswer) {
  std::mt19937_64 generator(3);
  PlacementProblem problem = around_the_disc(3);
  problem.area.clear();
  EXPECT_THROW(place_stations(problem, generator), std::invalid_argument);
  EXPECT_THROW(place_stations(around_the_disc(0), generator), std::invalid_argument);
  EXPECT_THROW(place_stations(around_the_disc(kPlaces + 1), generator), std::invalid_argument);
  EXPECT_THROW(rate_placement(around_the_disc(3), {0, 1, kPlaces}), std::invalid_argument);
}

}  // namespace
}  // namespace ols
