// More stations on one target than the filter has states for.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <set>

#include "dev/estimators/bearing_world.h"
#include "geometry/angles.h"

namespace ols::bench {
namespace {

using namespace ols::fusion;

using Eigen::Vector3d;

struct Seen {
  double nees = 0.0;  // over 3, of all targets
  int count = 0;
  std::set<std::int64_t> ids;
  std::size_t most_at_once = 0;
};

// Each states its bias, which is so large that only a filter that takes it for new in every frame
// would be more certain than twelve stations.
void fly(int stations, double rate_hz, std::uint64_t seed, Seen& seen) {
  constexpr double kDurationS = 8.0, kSettledS = 2.0;
  std::mt19937_64 random(seed);
  WorldConfig world{.stations_enu = circle(stations, 250.0), .aims_enu = {}, .rate_hz = rate_hz};
  world.bias_sd_rad = 2e-3;
  const Path path = cruising({{-60, 40, 80}, {9.0, -6.0, 1.0}}, 0.5, kDurationS, random);
  Fusion fusion(FusionConfig{.paper_targets = 0});
  for (const BearingMeasurement& measurement : measure(world, {path}, kDurationS, random)) {
    const FusionOutput output = fusion.add(measurement);
    seen.most_at_once = std::max(seen.most_at_once, output.targets.size());
    for (const FusedTarget& target : output.targets) {
      if (target.target_id != 0) seen.ids.insert(target.target_id);
      const double time_s = 1e-6 * static_cast<double>(target.utime_us - kStartUs);
      if (time_s < kSettledS || target.estimate.solution != Solution::kOk) continue;
      const Vector3d e = target.estimate.position_ecef - site().to_ecef(at(path, time_s).p_enu);
      seen.nees += e.dot(target.estimate.covariance_ecef.ldlt().solve(e)) / 3.0;
      ++seen.count;
    }
  }
}

// Beside another estimator, the paper's uses the first 100 stations, and says so.
TEST(ManyStations, ThinThePapersEstimateBesideTheFilters) {
  constexpr int kStations = 104;
  std::mt19937_64 random(3);
  WorldConfig world{.stations_enu = circle(kStations, 250.0), .aims_enu = {}, .rate_hz = 15.0};
  const Path path = cruising({{-60, 40, 80}, {9.0, -6.0, 1.0}}, 0.5, 2.0, random);
  Fusion fusion{FusionConfig{}};
  std::set<std::size_t> of_paper;
  for (const BearingMeasurement& measurement : measure(world, {path}, 2.0, random)) {
    for (const FusedTarget& target : fusion.add(measurement).targets_paper) {
      if (measurement.utime_us < kStartUs + 1'500'000) continue;
      EXPECT_EQ(target.estimate.solution, Solution::kOk);
      of_paper.insert(target.stations.size());
    }
  }
  EXPECT_EQ(of_paper, std::set<std::size_t>{100});
  EXPECT_GT(fusion.health().counters.at("paper_targets_thinned"), 0.0);
}

class ManyStationsRates : public testing::TestWithParam<double> {};

TEST_P(ManyStationsRates, AreNoSurerThanTheirBiasesLetThem) {
  constexpr int kRuns = 12;
  double nees = 0.0;
  for (int run = 1; run <= kRuns; ++run) {
    Seen seen;
    fly(16, GetParam(), static_cast<std::uint64_t>(run), seen);
    ASSERT_GT(seen.count, 0) << "seed " << run;
    EXPECT_EQ(seen.ids.size(), 1U) << "seed " << run;
    EXPECT_EQ(seen.most_at_once, 1U) << "seed " << run;
    nees += seen.nees / seen.count / kRuns;
  }
  // Of about three independent errors a run (the biases stay): 36 degrees of freedom.
  EXPECT_GT(nees, 0.4);
  EXPECT_LT(nees, 1.6);
}

// If more stations than one bearing can search see new targets at one instant, they take turns;
// every station gets its turn, even with false bearings in each frame.
TEST(ManyStations, WhatTheySeeAllAtOnceIsAllFound) {
  constexpr int kGroups = 24, kEach = 4;
  constexpr double kDurationS = 0.6;
  std::mt19937_64 random(3);
  std::vector<BearingMeasurement> all;
  std::vector<Path> paths;
  for (int group = 0; group < kGroups; ++group) {
    const Vector3d centre(3000.0 * (group % 6), 3000.0 * (group / 6), 0.0);
    WorldConfig world{.stations_enu = circle(kEach, 300.0), .aims_enu = {}, .false_per_frame = 0.5};
    for (Vector3d& place : world.stations_enu) place += centre;
    for (const Vector3d& place : world.stations_enu) {
      world.aims_enu.push_back(centre + Vector3d(0, 0, 100) - 0.01 * (place - centre));
    }
    paths.push_back(cruising({centre + Vector3d(0, 0, 100), {8, 3, 0}}, 0.5, kDurationS, random));
    for (BearingMeasurement& s : measure(world, {paths.back()}, kDurationS, random)) {
      s.station.append("g").append(std::to_string(group));
      all.push_back(std::move(s));
    }
  }
  std::ranges::stable_sort(all, {}, &BearingMeasurement::utime_us);
  Fusion fusion{FusionConfig{}};
  for (const BearingMeasurement& measurement : all) fusion.add(measurement);
  for (const Path& path : paths) {
    const Vector3d there = site().to_ecef(at(path, kDurationS).p_enu);
    const auto near = std::ranges::count_if(fusion.tracks().tracks(), [&](const Track& track) {
      return is_established(track) && (track.filter.position() - there).norm() < 3.0;
    });
    EXPECT_EQ(near, 1);
  }
  EXPECT_EQ(std::ranges::count_if(fusion.tracks().tracks(), is_established), kGroups);
}

// Upwards, away from all others: it intersects none.
BearingMeasurement of_nothing(BearingMeasurement measurement, double elevation_rad) {
  const Vector3d place = site().to_enu(measurement.sight.origin_ecef);
  measurement.sight.direction = {wrap_two_pi(std::atan2(place.x(), place.y())), elevation_rad};
  return measurement;
}

// 128 stations in a fixed order, two bearings in each frame: each has one search in a round of
// frames. In the frames of every other station the object's bearing comes second.
TEST(ManyStations, NobodysTurnFallsOnTheSameBearingForEver) {
  constexpr std::size_t kStations = 128;
  constexpr int kFrames = 60;
  const Path path(4000, PathPoint{Vector3d(0, 0, 200), Vector3d::Zero()});
  for (const bool second : {false, true}) {
    for (const std::size_t first_station : {0, 1}) {
      std::mt19937_64 random(4);
      WorldConfig world{.stations_enu = circle(kStations, 2000.0), .aims_enu = {}};
      auto seen = measure(world, {path}, kFrames / world.rate_hz, random);
      Fusion fusion{FusionConfig{}};
      for (std::size_t i = 0; i < seen.size(); ++i) {
        const std::size_t station = i % kStations;
        const BearingMeasurement other = of_nothing(seen[i], 1.2);
        const BearingMeasurement own =
            station % 32 == first_station ? seen[i] : of_nothing(seen[i], 1.1);
        fusion.add(second ? other : own);
        fusion.add(second ? own : other);
      }
      EXPECT_EQ(std::ranges::count_if(fusion.tracks().tracks(), is_established), 1)
          << second << ' ' << first_station;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Hz, ManyStationsRates, testing::Values(15.0, 30.0));

}  // namespace
}  // namespace ols::bench
