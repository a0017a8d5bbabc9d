// Two stations alone: one residual, and nothing to check it.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <optional>
#include <set>
#include <vector>

#include "central/offline/offline_fusion.h"
#include "central/tracking/track_initiation.h"
#include "dev/estimators/bearing_world.h"

namespace ols::bench {

using namespace ols::fusion;

namespace {

using Eigen::Vector3d;

constexpr double kDurationS = 8.0;

std::vector<Vector3d> stations() { return {{-210, -210, 0}, {210, -210, 0}}; }

Path climbing(const Vector3d& from, double speed_m_s, double duration_s = kDurationS) {
  std::mt19937_64 random(1);
  return cruising({from, {0, 0, speed_m_s}}, 1e-6, duration_s, random);
}

// Each follows its own object; for a moment, three seconds after the start, their rays intersect.
std::vector<BearingMeasurement> of_two_objects() {
  const WorldConfig world{.stations_enu = stations(), .aims_enu = {}};
  std::mt19937_64 random(2);
  std::vector<BearingMeasurement> seen;
  const Path paths[] = {climbing({0, 0, 80}, 0.0), climbing({20, 10, 81}, 1.0)};
  for (const Path& path : paths) {
    for (BearingMeasurement& s : measure(world, {path}, kDurationS, random)) {
      s.track_id = 1;
      if ((s.station == "s0") == (&path == &paths[0])) seen.push_back(std::move(s));
    }
  }
  std::ranges::stable_sort(seen, {}, &BearingMeasurement::utime_us);
  return seen;
}

// One bearing of a third station, towards that point.
BearingMeasurement chance_bearing(const FusedTarget& target) {
  const WorldConfig world{.stations_enu = {{0, 300, 0}}, .aims_enu = {}};
  const Path there(100, PathPoint{site().to_enu(target.estimate.position_ecef), Vector3d::Zero()});
  std::mt19937_64 random(7);
  BearingMeasurement measurement = measure(world, {there}, 0.5, random).front();
  measurement.station = "s9";
  measurement.utime_us = target.utime_us;
  return measurement;
}

// That is a position until the rays part again; nothing is learnt as if both were one object, even
// if a third station has seen something there for a moment.
TEST(TwoStations, WhoFollowTwoObjectsAreAPositionOnlyWhileTheirRaysMeet) {
  for (const bool third : {false, true}) {
    Fusion fusion(FusionConfig{});
    double first_s = 0.0, last_s = 0.0;
    bool had_third = false;
    for (const BearingMeasurement& measurement : of_two_objects()) {
      for (const FusedTarget& target : fusion.add(measurement).targets) {
        if (target.estimate.solution != Solution::kOk) continue;
        last_s = 1e-6 * static_cast<double>(target.utime_us - kStartUs);
        if (first_s == 0.0) first_s = last_s;
        if (!third || had_third || last_s < first_s + 0.3) continue;
        had_third = true;
        fusion.add(chance_bearing(target));
      }
    }
    EXPECT_GT(first_s, 1.0) << "they meet: that cannot be told from one object";
    EXPECT_LT(last_s, third ? 6.5 : 5.5);
    EXPECT_EQ(had_third, third);
  }
}

// A track that begins on such rays, next to one that four stations follow, is deleted before it is
// confirmed; it must not leave its stations with the biases that made its rays intersect.
TEST(TwoStations, WhatTheirRaysHadToBeTurnedByIsForgottenWithATentativeTrack) {
  constexpr double kLongS = 40.0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    std::mt19937_64 random(seed);
    WorldConfig all{.stations_enu = circle(4, 300.0), .aims_enu = {}};
    all.bias_sd_rad = 3e-4;
    all.bias_stated = false;
    WorldConfig two = all;
    two.stations_enu.resize(2);
    std::vector<BearingMeasurement> seen =
        measure(all, {cruising({{-100, 20, 120}, {4, 1, 0}}, 0.1, kLongS, random)}, kLongS, random);
    const Path paths[] = {climbing({0, 0, 40}, 0.0, kLongS), climbing({20, 10, 30}, 1.0, kLongS)};
    for (const Path& path : paths) {
      for (BearingMeasurement& s : measure(two, {path}, kLongS, random)) {
        s.track_id = 2;
        if ((s.station == "s0") == (&path == &paths[0])) seen.push_back(std::move(s));
      }
    }
    std::ranges::stable_sort(seen, {}, &BearingMeasurement::utime_us);
    Fusion fusion(FusionConfig{});
    double greatest_rad = 0.0;
    for (const BearingMeasurement& measurement : seen) {
      fusion.add(measurement);
      const auto prior = fusion.tracks().errors().prior("s0", seen.front().sight, 300.0);
      greatest_rad = std::max(greatest_rad, std::sqrt(prior.covariance.trace()));
    }
    EXPECT_LT(greatest_rad, 3e-3) << seed;
  }
}

// A miss within their stated errors does not make them an inconsistent pair.
TEST(TwoStations, WhoseHeadingsAreAsStatedKeepTheirTarget) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    WorldConfig world{.stations_enu = stations(), .aims_enu = {}, .bias_sd_rad = 2e-3};
    std::mt19937_64 random(seed);
    const Path path = manoeuvring({{-30, 20, 80}, {12, 5, 0}}, 6.0, kDurationS, random);
    Fusion fusion(FusionConfig{});
    double nees = 0.0;
    int located = 0;
    for (const BearingMeasurement& measurement : measure(world, {path}, kDurationS, random)) {
      for (const FusedTarget& target : fusion.add(measurement).targets) {
        const double time_s = 1e-6 * static_cast<double>(target.utime_us - kStartUs);
        if (time_s < 1.5) continue;
        ASSERT_EQ(target.estimate.solution, Solution::kOk) << seed << ", " << time_s << " s";
        const Vector3d e = target.estimate.position_ecef - site().to_ecef(at(path, time_s).p_enu);
        nees += e.dot(target.estimate.covariance_ecef.ldlt().solve(e)) / 3.0;
        ++located;
      }
    }
    EXPECT_GT(located, 80) << seed;
    EXPECT_LT(nees / located, 6.0) << seed;
  }
}

// The published positions, and the last time that one was off by more than five sigmas.
struct Told {
  int fixes = 0, rays_miss = 0;
  std::size_t targets = 0;  // identities
  double first_s = 0.0, last_s = 0.0, last_wrong_s = 0.0;
};

Told told_of(const std::vector<BearingMeasurement>& seen, const Path& path) {
  constexpr double kSigmas = 5.0;
  Fusion fusion(FusionConfig{});
  Told told;
  std::set<std::int64_t> targets;
  for (const BearingMeasurement& measurement : seen) {
    for (const FusedTarget& target : fusion.add(measurement).targets) {
      told.rays_miss += target.estimate.solution == Solution::kRaysMiss ? 1 : 0;
      if (target.estimate.solution != Solution::kOk) continue;
      EXPECT_NE(target.target_id, 0);
      targets.insert(target.target_id);
      const double time_s = 1e-6 * static_cast<double>(target.utime_us - kStartUs);
      if (told.fixes++ == 0) told.first_s = time_s;
      told.last_s = time_s;
      const Vector3d e = target.estimate.position_ecef - site().to_ecef(at(path, time_s).p_enu);
      const double squared = e.dot(target.estimate.covariance_ecef.ldlt().solve(e));
      if (squared > kSigmas * kSigmas) told.last_wrong_s = time_s;
    }
  }
  told.targets = targets.size();
  return told;
}

// A precise pair on a short base, near its target. After one was silent the range is vague, and
// linearising about that estimate would put the target metres off with false certainty.
TEST(TwoStations, OfWhichOneIsHeardOfLateAreNotLedAstrayAtTheStart) {
  constexpr std::int64_t kLateUs = 100'000, kBeginsUs = 200'000;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const WorldConfig world{.stations_enu = {{-15, 0, 0}, {15, 0, 0}},
                            .aims_enu = {},
                            .rate_hz = 15.0,
                            .noise_rad = 2.6e-5,
                            .bias_sd_rad = 7.5e-5};
    std::mt19937_64 random(seed);
    const Path path = manoeuvring({{-5, 50, -0.5}, {0.3, 0.1, 0}}, 6.0, 2.0, random);
    auto seen = measure(world, {path}, 2.0, random);
    std::erase_if(seen, [&](const BearingMeasurement& s) {
      return s.station == "s1" && s.utime_us < kStartUs + kBeginsUs;
    });
    std::ranges::stable_sort(seen, {}, [&](const BearingMeasurement& s) {
      return s.utime_us + (s.station == "s1" ? kLateUs : 0);
    });
    TrackInitiation initiation({}, {});
    BiasModel errors;
    std::optional<TrackStart> start;
    for (auto s = seen.begin(); s != seen.end() && !start; ++s)
      start = initiation.add(*s, errors, false);
    ASSERT_TRUE(start) << seed;
    const KinematicState& state = start->track.filter.summary();
    const double time_s = 1e-6 * static_cast<double>(state.utime_us - kStartUs);
    const Vector3d e = state.mean.head<3>() - site().to_ecef(at(path, time_s).p_enu);
    EXPECT_LT(e.dot(state.covariance.topLeftCorner<3, 3>().ldlt().solve(e)), 25.0) << seed;
  }
}

// Many bearings of one station do not confirm a pair: the other one must agree five times.
TEST(TwoStations, OfWhichOneIsSlowAreConfirmedByTheSlowOne) {
  constexpr std::int64_t kEachUs = 300'000;
  const WorldConfig world{.stations_enu = stations(), .aims_enu = {}};
  std::mt19937_64 random(1);
  const Path path = cruising({{-30, 20, 80}, {12, 5, 0}}, 0.1, kDurationS, random);
  auto seen = measure(world, {path}, kDurationS, random);
  std::int64_t next_us = 0;
  std::erase_if(seen, [&](const BearingMeasurement& measurement) {
    if (measurement.station != "s1") return false;
    if (measurement.utime_us < next_us) return true;
    next_us = measurement.utime_us + kEachUs;
    return false;
  });
  const Told told = told_of(seen, path);
  EXPECT_GT(told.fixes, 15);
  EXPECT_GT(told.first_s, 1.3);
  EXPECT_EQ(told.last_wrong_s, 0.0);
}

// Three g, nearly along the line of sight of one of the two: only the other one sees it, and a
// station that always agrees with itself must not outvote it. Until they agree again there is no
// position.
TEST(TwoStations, FollowAHardTurnThatOnlyOneOfThemSees) {
  constexpr double kTurnS = 4.0, kHard = 30.0;
  const WorldConfig world{.stations_enu = {{-150, 0, 0}, {150, 0, 0}},
                          .aims_enu = {},
                          .noise_rad = 1e-4,
                          .bias_sd_rad = 3e-4};
  std::mt19937_64 random(5);
  Path path;
  PathPoint now{{0, 400, 80}, {12, 10, 0}};
  for (double time_s = 0.0; time_s < kDurationS + 0.1; time_s += 1.0 / kPathHz) {
    path.push_back(now);
    now.p_enu += now.v_enu / kPathHz;
    const Vector3d change = Vector3d(-15, -15, 0) - now.v_enu;
    const double most = kHard / kPathHz / std::max(change.norm(), 1e-9);
    if (time_s >= kTurnS) now.v_enu += std::min(1.0, most) * change;
  }
  auto seen = measure(world, {path}, kDurationS, random);
  for (BearingMeasurement& measurement : seen) measurement.track_id = 1;
  const Told told = told_of(seen, path);
  EXPECT_GT(told.fixes, 85);
  EXPECT_GT(told.rays_miss, 0);
  EXPECT_LT(told.last_wrong_s, kTurnS + 0.5);
}

// A third station with few bearings has shown which of them is wrong: the target stays theirs.
TEST(TwoStations, OfWhichOneIsWrongAreToldApartByASlowThird) {
  constexpr double kWrongS = 3.0;
  constexpr std::int64_t kEachUs = 900'000;
  const WorldConfig world{.stations_enu = {{-210, -210, 0}, {210, -210, 0}, {0, 300, 0}},
                          .aims_enu = {}};
  std::mt19937_64 random(1);
  const Path path = cruising({{-30, 20, 80}, {6, 2, 0}}, 0.1, kDurationS, random);
  auto seen = measure(world, {path}, kDurationS, random);
  const auto wrong_us = kStartUs + static_cast<std::int64_t>(1e6 * kWrongS);
  std::int64_t next_us = 0;
  std::erase_if(seen, [&](const BearingMeasurement& measurement) {
    if (measurement.station != "s2" || measurement.utime_us < wrong_us) return false;
    if (measurement.utime_us < next_us) return true;
    next_us = measurement.utime_us + kEachUs;
    return false;
  });
  for (BearingMeasurement& measurement : seen) {
    measurement.track_id = 1;
    if (measurement.station != "s0" || measurement.utime_us < wrong_us) continue;
    measurement.sight.direction.elevation_rad += 0.05;
  }
  const Told told = told_of(seen, path);
  EXPECT_GT(told.last_s, kDurationS - 0.5);
  EXPECT_EQ(told.targets, 1U);
  EXPECT_EQ(told.last_wrong_s, 0.0);
}

// Side by side, two milliradians apart: their undeclared errors look like a target that is twenty
// times nearer. With a third station far away the range is observable.
TEST(TwoStations, SideBySideTheyTellNoRangeOfWhatIsFar) {
  constexpr double kOffRad = 2e-3, kFlightS = 5.0, kSecondS = 0.03;
  for (const bool third : {false, true}) {
    WorldConfig world{.stations_enu = {{0, 0, 0}, {0, 25, 0}}, .aims_enu = {}};
    if (third) world.stations_enu.emplace_back(20e3, 0, 0);
    std::mt19937_64 random(1);
    const Path path = cruising({{0, 150e3, 80e3}, {300, -900, 0}}, 0.1, kFlightS, random);
    auto seen = measure(world, {path}, kFlightS, random);
    for (BearingMeasurement& measurement : seen) {
      const double off_rad = measurement.station == "s0" ? -0.5 * kOffRad : 0.5 * kOffRad;
      measurement.sight.direction.elevation_rad += off_rad;
    }
    int fixes = 0;
    double farthest_m = 0.0;
    for (const FusedTarget& target : fuse_offline(seen, {})) {
      if (target.estimate.solution != Solution::kOk) continue;
      ++fixes;
      const double time_s = 1e-6 * static_cast<double>(target.utime_us - kStartUs);
      const Vector3d truth = site().to_ecef(at(path, time_s).p_enu);
      if (time_s < kSecondS) continue;  // one bearing of each is not enough to judge by
      farthest_m = std::max(farthest_m, (target.estimate.position_ecef - truth).norm());
    }
    EXPECT_EQ(fixes > 0, third);
    EXPECT_LT(farthest_m, 10e3);
  }
}

// ... and is unobservable again long after the third one has left.
TEST(TwoStations, SideBySideTheyForgetTheRangeThatAThirdHasTold) {
  constexpr double kOffRad = 2e-3, kFlightS = 40.0, kLeavesS = 1.0;
  WorldConfig world{.stations_enu = {{0, 0, 0}, {0, 25, 0}, {20e3, 0, 0}}, .aims_enu = {}};
  world.rate_hz = 10.0;
  std::mt19937_64 random(1);
  const Path path = cruising({{0, 150e3, 80e3}, {300, -900, 0}}, 0.1, kFlightS, random);
  auto seen = measure(world, {path}, kFlightS, random);
  const auto leaves_us = kStartUs + static_cast<std::int64_t>(1e6 * kLeavesS);
  std::erase_if(seen, [&](const BearingMeasurement& measurement) {
    return measurement.station == "s2" && measurement.utime_us > leaves_us;
  });
  for (BearingMeasurement& measurement : seen) {
    if (measurement.station == "s1") measurement.sight.direction.elevation_rad += kOffRad;
  }
  double last_s = 0.0;
  for (const FusedTarget& target : fuse_offline(seen, {})) {
    if (target.estimate.solution != Solution::kOk) continue;
    last_s = 1e-6 * static_cast<double>(target.utime_us - kStartUs);
  }
  EXPECT_GT(last_s, kLeavesS - 0.2);
  EXPECT_LT(last_s, kLeavesS + 31.0);
}

}  // namespace
}  // namespace ols::bench
