// The fusion with the land: ghosts below and behind it, one station and what stands on it.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cstdio>
#include <memory>
#include <random>
#include <set>

#include "central/ground/above_ground.h"
#include "central/ground/visibility.h"
#include "dev/estimators/bearing_world.h"
#include "tests/unit/central/ground/lands.h"

namespace ols::bench {

using namespace ols::fusion;

namespace {

using Eigen::Vector3d;

// Hills of 10 m, at the height of the site's origin.
double hills(double east_m, double north_m) {
  return site().origin().height_m + 10.0 * std::sin(east_m / 90.0) * std::cos(north_m / 110.0);
}

std::shared_ptr<const Land> land_of(const Land::Height& height, double sd_m) {
  Geodetic place = site().origin();
  place.height_m = 0.0;
  return std::make_shared<const Land>(height, sd_m, place);
}

// On the hills, at a constant speed on the map.
Path drive(const Land& land, const Vector3d& from_enu, const Vector3d& v_enu, double duration_s,
           double middle_m = kMiddle_m) {
  Path path;
  for (int i = 0; i <= static_cast<int>(duration_s * kPathHz) + 1; ++i) {
    const Vector3d p = from_enu + i / kPathHz * v_enu;
    path.push_back({site().to_enu(land.on_ground(p.x(), p.y(), middle_m)), v_enu});
  }
  return path;
}

struct Ghosts {
  std::set<std::int64_t> below_or_behind, elsewhere;
  int of_the_drone = 0;
};

// Each of two stations follows six vehicles of its own, and both follow a drone.
Ghosts ghosts_of(std::uint64_t seed, bool knows_land) {
  constexpr double kLong_s = 6.0;
  const auto land = land_of(hills, 1.0);
  const WorldConfig world{.stations_enu = {{-250, 0, 60}, {250, 0, 60}},
                          .aims_enu = {},
                          .rate_hz = 15.0,
                          .bias_sd_rad = 1e-3};
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const auto place = [&] { return Vector3d(400.0 * any(random), 450.0 + 250.0 * any(random), 0); };
  const auto speed = [&] { return Vector3d(4.0 * any(random), 4.0 * any(random), 0); };
  std::vector<Path> paths{cruising({{0, 300, 90}, {5, 2, 0}}, 0.1, kLong_s, random)};
  for (int i = 0; i < 12; ++i) paths.push_back(drive(*land, place(), speed(), kLong_s));
  std::vector<BearingMeasurement> seen;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    for (BearingMeasurement& s : measure(world, {paths[i]}, kLong_s, random)) {
      s.track_id = static_cast<std::int64_t>(i) + 1;
      if (i == 0 || (s.station == "s0") == (i % 2 == 0)) seen.push_back(std::move(s));
    }
  }
  std::ranges::stable_sort(seen, {}, &BearingMeasurement::utime_us);
  FusionConfig config;
  if (knows_land) config.land.surface = land;
  Fusion fusion(config);
  Ghosts ghosts;
  for (const BearingMeasurement& measurement : seen) {
    for (const FusedTarget& target : fusion.add(measurement).targets) {
      if (target.estimate.solution != Solution::kOk) continue;
      const Vector3d& p = target.estimate.position_ecef;
      const double time_s = 1e-6 * static_cast<double>(target.utime_us - kStartUs);
      const bool is_drone = (p - site().to_ecef(at(paths[0], time_s).p_enu)).norm() < 10.0;
      bool is_impossible = false;
      for (const Vector3d& station : world.stations_enu) {
        is_impossible |= plausibility(*land, site().to_ecef(station), p,
                                      target.estimate.covariance_ecef) < kImplausible;
      }
      if (is_drone) {
        ++ghosts.of_the_drone;
        EXPECT_FALSE(is_impossible);
      } else {
        (is_impossible ? ghosts.below_or_behind : ghosts.elsewhere).insert(target.target_id);
      }
    }
  }
  return ghosts;
}

TEST(FusionWithLand, PublishesNoGhostsBelowOrBehindIt) {
  std::size_t without = 0, with = 0, elsewhere_without = 0, elsewhere_with = 0;
  int drone_without = 0, drone_with = 0;
  constexpr std::uint64_t kSeeds = 8;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Ghosts before = ghosts_of(seed, false), after = ghosts_of(seed, true);
    without += before.below_or_behind.size();
    with += after.below_or_behind.size();
    elsewhere_without += before.elsewhere.size();
    elsewhere_with += after.elsewhere.size();
    drone_without += before.of_the_drone;
    drone_with += after.of_the_drone;
  }
  std::printf(
      "seeds 1..%d: ghosts below or behind %zu without the land, %zu with it; elsewhere %zu, %zu; "
      "fixes of the drone %d, %d\n",
      static_cast<int>(kSeeds), without, with, elsewhere_without, elsewhere_with, drone_without,
      drone_with);
  EXPECT_GT(without, 5U);
  EXPECT_EQ(with, 0U);
  EXPECT_GE(drone_with, drone_without);
}

// The alarms of a fusion with this land and two stations at the height of the site's origin.
std::string alarms_with(std::shared_ptr<const Land> land, double position_sd_m) {
  FusionConfig config;
  config.land.surface = std::move(land);
  Fusion fusion(config);
  std::mt19937_64 random(3);
  const WorldConfig world{.stations_enu = {{-250, 0, 0}, {250, 0, 0}}, .aims_enu = {}};
  const Path path = cruising({{0, 300, 90}, {5, 2, 0}}, 0.1, 1.0, random);
  for (BearingMeasurement& one : measure(world, {path}, 1.0, random)) {
    one.sight.origin_sd_enu_m.setConstant(position_sd_m);
    fusion.add(one);
  }
  std::string texts;
  for (const Alarm& alarm : fusion.health().alarms) texts += alarm.text + '\n';
  return texts;
}

TEST(FusionWithLand, SaysWhichStationDoesNotStandOnIt) {
  const auto level = [](double above_m) {
    return land_of([=](double, double) { return site().origin().height_m + above_m; }, 1.0);
  };
  const std::string under = alarms_with(level(30.0), 2.0);
  EXPECT_NE(under.find("station s0: stands 30 m under the ground of the land"), std::string::npos)
      << under;
  EXPECT_NE(under.find("station s1: stands 30 m under"), std::string::npos) << under;
  EXPECT_EQ(alarms_with(level(30.0), 20.0).find("land"), std::string::npos);
  EXPECT_EQ(alarms_with(level(-30.0), 2.0).find("land"), std::string::npos);
  Geodetic far = site().origin();
  far.latitude_rad += 0.01;
  const auto elsewhere = std::make_shared<const Land>([](double, double) { return 0.0; }, 1.0, far);
  const std::string outside = alarms_with(elsewhere, 2.0);
  EXPECT_NE(outside.find("station s0: stands outside of the known land"), std::string::npos)
      << outside;
}

// One station 60 m above hills follows a vehicle; after half of the time a second one, too.
TEST(FusionWithLand, GivesAPositionOfWhatStandsOnTheGroundFromOneStation) {
  constexpr double kLong_s = 6.0, kSecond_s = 3.0, kModelSd_m = 0.5;
  double nees[2] = {0.0, 0.0}, length_m[2] = {0.0, 0.0};
  int fixes[2] = {0, 0};
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    const auto truth = land_of(hills, kModelSd_m);
    const double off_m = kModelSd_m * normal(random);
    const auto model = land_of([&](double e, double n) { return hills(e, n) + off_m; }, kModelSd_m);
    const Vector3d first = site().to_enu(truth->on_ground(0, 0, 60.0));
    const Vector3d second = site().to_enu(truth->on_ground(400, 100, 60.0));
    const WorldConfig world{
        .stations_enu = {first, second}, .aims_enu = {}, .rate_hz = 15.0, .bias_sd_rad = 2e-4};
    const Path path =
        drive(*truth, {-300, 700, 0}, {8, 3, 0}, kLong_s, kMiddle_m + kMiddleSd_m * normal(random));
    Fusion fusion({.land = {model, {"s0"}}});
    std::set<std::int64_t> ids;
    for (BearingMeasurement s : measure(world, {path}, kLong_s, random)) {
      s.track_id = 1;
      if (s.station == "s1" && s.utime_us < kStartUs + static_cast<std::int64_t>(1e6 * kSecond_s))
        continue;
      for (const FusedTarget& target : fusion.add(s).targets) {
        if (target.estimate.solution != Solution::kOk) continue;
        const bool has_two = target.stations.size() > 1;
        EXPECT_EQ(target.estimator, has_two ? "filter" : "ground");
        EXPECT_TRUE(target.above_ground);
        EXPECT_LT(std::abs(target.above_ground->height_m), 5.0);
        ids.insert(target.target_id);
        const double time_s = 1e-6 * static_cast<double>(target.utime_us - kStartUs);
        const Vector3d e = target.estimate.position_ecef - site().to_ecef(at(path, time_s).p_enu);
        nees[has_two] += e.dot(target.estimate.covariance_ecef.ldlt().solve(e)) / 3.0;
        length_m[has_two] += std::sqrt(target.estimate.covariance_ecef.trace());
        ++fixes[has_two];
      }
    }
    EXPECT_EQ(ids.size(), 1U) << seed;
  }
  for (int two = 0; two < 2; ++two) {
    std::printf("seeds 1..40, %d station(s): %d fixes, NEES %.2f, 1-sigma %.1f m\n", two + 1,
                fixes[two], nees[two] / fixes[two], length_m[two] / fixes[two]);
    EXPECT_GT(fixes[two], 1000);
    EXPECT_GT(nees[two] / fixes[two], 0.7);
    EXPECT_LT(nees[two] / fixes[two], 1.4);
  }
  EXPECT_LT(length_m[1] / fixes[1], 0.5 * length_m[0] / fixes[0]);
}

// Nobody has said that it stands there: it may be a drone before the hillside.
TEST(FusionWithLand, LeavesALineOfWhatMayFlyALine) {
  const auto land = land_of(hills, 1.0);
  const WorldConfig world{.stations_enu = {site().to_enu(land->on_ground(0, 0, 60.0))},
                          .aims_enu = {}};
  std::mt19937_64 random(1);
  Fusion fusion({.land = {land, {"s7"}}});
  const Path path = drive(*land, {-300, 700, 0}, {8, 3, 0}, 2.0);
  for (BearingMeasurement s : measure(world, {path}, 2.0, random)) {
    s.track_id = 1;
    for (const FusedTarget& target : fusion.add(s).targets)
      EXPECT_EQ(target.estimate.solution, Solution::kBearingOnly);
  }
}

}  // namespace
}  // namespace ols::bench
