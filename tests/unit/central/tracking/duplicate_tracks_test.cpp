// Two tracks of one object are merged; two objects that fly side by side are not.
#include "central/tracking/duplicate_tracks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <set>

#include "dev/estimators/bearing_world.h"

namespace ols::bench {

using namespace ols::fusion;

namespace {

using Eigen::Vector3d;

constexpr double kDurationS = 10.0, kStatedRad = 3e-4;

struct Flight {
  int stations = 4;
  double noise = 1.0;    // over the stated one
  double apart_m = 0.0;  // distance of a second object; 0: only one
  bool named = false;    // each station follows one object by a track id; every other the second
  double missed = 0.05;
};

// The second one flies about the first, so that they cross in every station's view.
std::vector<Path> paths_of(const Flight& flight, std::mt19937_64& random) {
  std::vector<Path> paths = {cruising({{-60, 40, 80}, {6, -4, 0.5}}, 0.5, kDurationS, random)};
  if (flight.apart_m == 0.0) return paths;
  Path beside = paths[0];
  for (std::size_t i = 0; i < beside.size(); ++i) {
    const double angle = std::numbers::pi / kDurationS * static_cast<double>(i) / kPathHz;
    beside[i].p_enu += flight.apart_m * Vector3d(std::cos(angle), std::sin(angle), 0.0);
  }
  paths.push_back(beside);
  return paths;
}

std::vector<BearingMeasurement> bearings_of(const Flight& flight, const std::vector<Path>& paths,
                                            std::mt19937_64& random) {
  WorldConfig world{.stations_enu = circle(flight.stations, 300.0), .aims_enu = {}};
  world.noise_rad = kStatedRad * flight.noise;
  world.missed = flight.missed;
  std::vector<BearingMeasurement> all;
  if (!flight.named) all = measure(world, paths, kDurationS, random);
  for (std::size_t i = 0; flight.named && i < paths.size(); ++i) {
    for (BearingMeasurement& s : measure(world, {paths[i]}, kDurationS, random)) {
      s.track_id = 1;
      if ((s.station.back() - '0') % paths.size() == i) all.push_back(std::move(s));
    }
  }
  for (BearingMeasurement& s : all) s.sight.covariance_white /= flight.noise * flight.noise;
  std::ranges::stable_sort(all, {}, &BearingMeasurement::utime_us);
  return all;
}

struct Seen {
  std::size_t at_the_end = 0;  // confirmed tracks
  std::int64_t merged = 0;
  bool oldest_stays = true;  // when two are merged
  double off_m = 0.0;        // of each object at the end, from the nearest track
};

std::set<std::int64_t> sure_ids(const Fusion& fusion) {
  std::set<std::int64_t> ids;
  for (const Track& track : fusion.tracks().tracks()) {
    if (is_established(track)) ids.insert(track.id);
  }
  return ids;
}

Seen fly(const Flight& flight, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const std::vector<Path> paths = paths_of(flight, random);
  Fusion fusion(FusionConfig{.paper_targets = 0});
  Seen seen;
  for (const BearingMeasurement& s : bearings_of(flight, paths, random)) {
    const auto before = sure_ids(fusion);
    fusion.add(s);
    if (fusion.tracks().counts().merged == seen.merged) continue;
    seen.merged = fusion.tracks().counts().merged;
    seen.oldest_stays = seen.oldest_stays && sure_ids(fusion).contains(*before.begin());
  }
  seen.at_the_end = sure_ids(fusion).size();
  for (const Path& path : paths) {
    const Vector3d there = site().to_ecef(at(path, kDurationS).p_enu);
    double least_m = 1e9;
    for (const Track& track : fusion.tracks().tracks()) {
      if (is_established(track))
        least_m = std::min(least_m, (track.filter.position() - there).norm());
    }
    seen.off_m = std::max(seen.off_m, least_m);
  }
  return seen;
}

// Most of the noise is outside the gate before it is learnt: several tracks are confirmed.
TEST(DuplicateTracks, OneObjectIsOneTrackAlsoWhereItsNoiseIsFiveTimesTheStatedOne) {
  std::int64_t merged = 0;
  for (const bool named : {false, true}) {
    for (const int stations : {3, 4}) {
      for (const double noise : {4.0, 5.0}) {
        for (std::uint64_t seed = 1; seed <= 6; ++seed) {
          const Seen seen = fly({.stations = stations, .noise = noise, .named = named}, seed);
          EXPECT_EQ(seen.at_the_end, 1U) << stations << ' ' << noise << ' ' << named << ' ' << seed;
          EXPECT_TRUE(seen.oldest_stays) << noise << ' ' << named << ' ' << seed;
          EXPECT_LT(seen.off_m, 1.5) << noise << ' ' << named << ' ' << seed;
          merged += seen.merged;
        }
      }
    }
  }
  EXPECT_GT(merged, 20);
}

// Two stations of 23 exposures, whose bearing both tracks explain, each of them every other time
// better; in some exposures there is one bearing for each.
bool are_same_with_apart(int exposures_apart) {
  DuplicateTracks duplicates({.memory_s = 1e6});
  for (int k = 0; k < 23; ++k) {
    for (const char* station : {"a", "b"}) {
      BearingMeasurement bearing;
      bearing.station = station;
      bearing.utime_us = 1'000'000 + 100'000 * k;
      const std::vector<std::int64_t> best_first =
          k % 2 == 0 ? std::vector<std::int64_t>{1, 2} : std::vector<std::int64_t>{2, 1};
      duplicates.note(bearing, best_first);
      ++bearing.utime_us;  // a station converts the time of each bearing by itself
      if (k < exposures_apart) duplicates.note(bearing, std::span(best_first).last(1));
    }
  }
  return duplicates.same().size() == 1;
}

// A station judges 22 of them: the newest is not complete yet.
TEST(DuplicateTracks, AreTwoAboveOneExposureOf20WithABearingForEach) {
  EXPECT_TRUE(are_same_with_apart(0));
  EXPECT_TRUE(are_same_with_apart(1)) << "2 of 42";
  EXPECT_FALSE(are_same_with_apart(2)) << "4 of 40";
}

TEST(DuplicateTracks, TwoObjectsSideBySideStayTwo) {
  for (const int stations : {3, 4}) {
    for (const double apart_m : {5.0, 2.5}) {
      for (const double missed : {0.05, 0.4}) {
        for (std::uint64_t seed = 1; seed <= 6; ++seed) {
          const Seen seen = fly({.stations = stations, .apart_m = apart_m, .missed = missed}, seed);
          EXPECT_GE(seen.at_the_end, 2U) << stations << ' ' << apart_m << ' ' << missed;
          EXPECT_EQ(seen.merged, 0) << stations << ' ' << apart_m << ' ' << missed;
          EXPECT_LT(seen.off_m, 1.0) << stations << ' ' << apart_m << ' ' << missed;
        }
      }
    }
  }
}

// Also where their noise makes several tracks of each.
TEST(DuplicateTracks, TwoObjectsSideBySideWithUntoldNoiseAreTwoInTheEnd) {
  for (const int stations : {3, 4}) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      const Seen seen = fly({.stations = stations, .noise = 4.0, .apart_m = 5.0}, seed);
      EXPECT_EQ(seen.at_the_end, 2U) << stations << " seed " << seed;
      EXPECT_LT(seen.off_m, 1.5) << stations << " seed " << seed;
    }
  }
}

// Each of eight stations follows one of two objects, and never has a bearing for each.
TEST(DuplicateTracks, TwoObjectsThatNobodySeesBothOfStayTwo) {
  for (const double noise : {1.0, 3.0}) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      const Seen seen = fly({.stations = 8, .noise = noise, .apart_m = 5.0, .named = true}, seed);
      EXPECT_GE(seen.at_the_end, 2U) << noise << " seed " << seed;
      EXPECT_LT(seen.off_m, 1.5) << noise << " seed " << seed;
    }
  }
}

TEST(DuplicateTracks, AlsoWhenTheyAreNearToEachOther) {
  for (std::uint64_t seed = 11; seed <= 16; ++seed) {
    const Seen seen = fly({.stations = 8, .apart_m = 3.0, .named = true}, seed);
    EXPECT_EQ(seen.merged, 0) << "seed " << seed;
    EXPECT_GE(seen.at_the_end, 2U) << "seed " << seed;
  }
}

// Ten thousand unrelated pairs take no memory permanently.
TEST(DuplicateTracks, PairsWithoutEvidenceAreForgotten) {
  DuplicateTracks duplicates;
  BearingMeasurement measurement;
  measurement.station = "a";
  for (std::int64_t i = 0; i < 10000; ++i) {
    measurement.utime_us = kStartUs + 10'000 * i;
    const std::int64_t both[] = {2 * i + 1, 2 * i + 2};
    duplicates.note(measurement, both);
  }
  EXPECT_TRUE(duplicates.same().empty());
  measurement.utime_us += 10'000'000;
  const std::int64_t one[] = {1};
  duplicates.note(measurement, one);
  EXPECT_TRUE(duplicates.empty());
}

}  // namespace
}  // namespace ols::bench
