// The fusion's output of a period: identities of bearing-only tracks, and the shares of many
// targets.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "dev/estimators/bearing_world.h"
#include "tests/unit/central/flight.h"

namespace ols::fusion {
namespace {

using test::flight;
using test::kStart;
using test::targets_of;

std::int64_t us(double seconds) { return kStart + std::llround(seconds * 1e6); }

// A flight whose stations follow an object, each by a constant track id.
std::vector<BearingMeasurement> followed(double seconds) {
  auto measurements = flight(seconds, 1e-4, 1e-4);
  for (BearingMeasurement& measurement : measurements) measurement.track_id = 7;
  return measurements;
}

void turn(BearingMeasurement& measurement, double azimuth_rad) {
  double& azimuth = measurement.sight.direction.azimuth_rad;
  azimuth = wrap_two_pi(azimuth + azimuth_rad);
}

// One station, then all, then that one again: bearing-only, position, and bearing-only of one
// object.
TEST(FusionEpoch, ALineIsTheObjectThatItsPositionIs) {
  auto measurements = followed(9.0);
  std::erase_if(measurements, [](const BearingMeasurement& s) {
    return s.station != "b" && (s.utime_us < us(2.0) || s.utime_us > us(4.0));
  });
  Fusion fusion{FusionConfig{}};
  std::set<std::int64_t> ids;
  int before = 0, positions = 0, after = 0;
  for (const FusedTarget& target : targets_of(fusion, measurements)) {
    if (target.utime_us < us(1.0) || target.target_id == 0) continue;
    ids.insert(target.target_id);
    before += target.bearing_only && target.utime_us < us(2.0) ? 1 : 0;
    positions += target.estimate.solution == Solution::kOk ? 1 : 0;
    after += target.bearing_only && target.utime_us > us(7.0) ? 1 : 0;
  }
  EXPECT_EQ(ids.size(), 1U);
  EXPECT_GT(before, 10);
  EXPECT_GT(positions, 20);
  EXPECT_GT(after, 20);
}

TEST(FusionEpoch, WhatAStationFollowsNextIsAnotherObject) {
  auto measurements = followed(4.0);
  std::erase_if(measurements, [](const BearingMeasurement& s) { return s.station != "b"; });
  for (BearingMeasurement& measurement : measurements) {
    if (measurement.utime_us > us(2.0)) measurement.track_id = 8;
  }
  Fusion fusion{FusionConfig{}};
  std::set<std::int64_t> first, second;
  for (const FusedTarget& target : targets_of(fusion, measurements)) {
    if (!target.bearing_only || target.target_id == 0) continue;
    // A silent station's bearing-only track is still published for this long.
    if (target.utime_us > us(2.0) && target.utime_us < us(2.4)) continue;
    (target.utime_us < us(2.0) ? first : second).insert(target.target_id);
  }
  EXPECT_EQ(first.size(), 1U);
  EXPECT_EQ(second.size(), 1U);
  EXPECT_NE(first, second);
}

// Two track ids of one station are two objects, each while it is followed.
std::vector<BearingMeasurement> two_of_one_station(double seconds) {
  auto measurements = followed(seconds);
  std::erase_if(measurements, [](const BearingMeasurement& s) { return s.station != "b"; });
  const std::size_t count = measurements.size();
  for (std::size_t i = 0; i < count; ++i) {
    measurements.push_back(measurements[i]);
    measurements.back().track_id = 9;
    turn(measurements.back(), 0.3);
  }
  std::ranges::stable_sort(measurements, {}, &BearingMeasurement::utime_us);
  return measurements;
}

TEST(FusionEpoch, WhatOneStationFollowsAtOnceAreTwoLines) {
  Fusion fusion{FusionConfig{}};
  std::map<std::int64_t, std::set<std::int64_t>> ids;      // by the station's track id
  std::map<std::int64_t, std::set<std::int64_t>> at_once;  // by the instant
  int lines = 0;
  for (const FusedTarget& target : targets_of(fusion, two_of_one_station(4.0))) {
    if (target.utime_us < us(1.0)) continue;
    ASSERT_TRUE(target.bearing_only);
    ids[target.bearing_only->track_id].insert(target.target_id);
    EXPECT_TRUE(at_once[target.utime_us].insert(target.target_id).second);
    ++lines;
  }
  ASSERT_EQ(ids.size(), 2U);
  EXPECT_EQ(ids[7].size(), 1U);
  EXPECT_EQ(ids[9].size(), 1U);
  EXPECT_NE(ids[7], ids[9]);
  EXPECT_EQ(lines, 2 * static_cast<int>(at_once.size()));
  EXPECT_GT(lines, 80);
}

// All stations see one object, and one station also another: before, during and after the first is
// a target.
TEST(FusionEpoch, AStationsLineBesideItsTargetKeepsItsIdentity) {
  auto measurements = two_of_one_station(8.0);
  for (const BearingMeasurement& s : followed(8.0)) {
    if (s.station != "b" && s.utime_us > us(2.0) && s.utime_us < us(4.0)) measurements.push_back(s);
  }
  std::ranges::stable_sort(measurements, {}, &BearingMeasurement::utime_us);
  Fusion fusion{FusionConfig{}};
  std::map<std::int64_t, std::set<std::int64_t>> ids;
  std::map<std::int64_t, int> beside;
  int positions = 0;
  for (const FusedTarget& target : targets_of(fusion, measurements)) {
    if (target.utime_us < us(1.0) || target.target_id == 0) continue;
    const std::int64_t name = target.bearing_only ? target.bearing_only->track_id : 7;
    ids[name].insert(target.target_id);
    positions += target.bearing_only ? 0 : 1;
    if (target.utime_us > us(2.5) && target.utime_us < us(4.0)) ++beside[name];
  }
  EXPECT_GT(positions, 20);
  EXPECT_GT(beside[9], 15);
  EXPECT_EQ(ids[7].size(), 1U);
  EXPECT_EQ(ids[9].size(), 1U);
  EXPECT_NE(ids[7], ids[9]);
}

// An outlier of each of two objects goes to the target that the station follows by that track id.
TEST(FusionEpoch, AStationFollowsTwoTargetsByTheirNames) {
  auto measurements = followed(3.0);
  const std::size_t count = measurements.size();
  for (std::size_t i = 0; i < count; ++i) {
    BearingMeasurement& own = measurements[i];
    const Eigen::Vector3d place = test::square()[static_cast<std::size_t>(own.station[0] - 'a')];
    const double t_s = 1e-6 * static_cast<double>(own.utime_us - kStart);
    const Eigen::Vector3d there = test::path(t_s) + Eigen::Vector3d(0, 0, 60);
    Ray ray = test::ray_to(own.station, place, there, 1e-4);
    measurements.push_back(test::measurement_of(ray, own.utime_us));
    measurements.back().track_id = 9;
  }
  std::ranges::stable_sort(measurements, {}, &BearingMeasurement::utime_us);
  for (BearingMeasurement& s : measurements) {
    if (s.station == "a" && s.utime_us > us(2.5)) s.sight.direction.elevation_rad += 0.01;
  }
  Fusion fusion{FusionConfig{}};
  for (const BearingMeasurement& s : measurements) fusion.add(s);
  // Half a second of it, 15 frames a second, of either.
  EXPECT_GE(fusion.tracks().counts().rejected, 12);
  EXPECT_EQ(std::ranges::count_if(fusion.tracks().tracks(), is_established), 2);
}

// Every bearing has a new track id: this has no effect, and memory stays bounded.
TEST(FusionEpoch, AStationThatNamesEverythingAnewIsForgottenAsItGoes) {
  auto measurements = followed(4.0);
  std::int64_t name = 100;
  for (BearingMeasurement& measurement : measurements) {
    if (measurement.station != "a") continue;
    measurement.track_id = ++name;
    turn(measurement, 0.5);
  }
  Fusion fusion{FusionConfig{}};
  for (const BearingMeasurement& measurement : measurements) {
    std::map<std::string, std::size_t> lines;
    for (const FusedTarget& target : fusion.add(measurement).targets) {
      if (target.bearing_only) ++lines[target.bearing_only->station];
    }
    EXPECT_LE(lines["a"], 4U);
    EXPECT_LE(fusion.tracks().followed().size("a"), LocalTracks::kOfAStation);
  }
  EXPECT_EQ(fusion.tracks().followed().size("a"), LocalTracks::kOfAStation);
  EXPECT_EQ(std::ranges::count_if(fusion.tracks().tracks(), is_established), 1);
}

// Detections without a track id may be of any object.
TEST(FusionEpoch, WhatAStationDoesNotNameHasNoIdentity) {
  auto measurements = flight(3.0);
  std::erase_if(measurements, [](const BearingMeasurement& s) { return s.station != "b"; });
  Fusion fusion{FusionConfig{}};
  for (const FusedTarget& target : targets_of(fusion, measurements)) EXPECT_EQ(target.target_id, 0);
}

// All have followed one object; then each follows an object of its own by the same track id.
TEST(FusionEpoch, OneIdentityIsNotTwoLines) {
  auto measurements = followed(9.0);
  const std::map<std::string, double> turned = {{"a", 0.0}, {"b", 0.7}, {"c", 1.4}, {"d", 2.1}};
  for (BearingMeasurement& measurement : measurements) {
    if (measurement.utime_us > us(3.0)) {
      turn(measurement, turned.at(measurement.station));
      measurement.sight.direction.elevation_rad += 0.2 * turned.at(measurement.station);
    }
  }
  Fusion fusion{FusionConfig{}};
  std::map<std::int64_t, std::set<std::int64_t>> at_instant;
  std::map<std::string, std::set<std::int64_t>> of_station;
  int lines = 0;
  for (const FusedTarget& target : targets_of(fusion, measurements)) {
    if (target.target_id == 0) continue;
    EXPECT_TRUE(at_instant[target.utime_us].insert(target.target_id).second);
    if (!target.bearing_only || target.utime_us < us(7.0)) continue;
    of_station[target.bearing_only->station].insert(target.target_id);
    ++lines;
  }
  EXPECT_GT(lines, 60);
  std::set<std::int64_t> all;
  for (const auto& [station, ids] : of_station) {
    EXPECT_EQ(ids.size(), 1U) << station;
    all.insert(ids.begin(), ids.end());
  }
  EXPECT_EQ(all.size(), of_station.size());
}

constexpr int kTargets = 30, kEach = 3;

// Groups of stations, each with its own target. In order of time.
std::vector<BearingMeasurement> many_targets(double seconds) {
  std::mt19937_64 random(5);
  std::vector<BearingMeasurement> all;
  for (int group = 0; group < kTargets; ++group) {
    const Eigen::Vector3d centre(3000.0 * (group % 6), 3000.0 * (group / 6), 0.0);
    bench::WorldConfig world{.stations_enu = bench::circle(kEach, 300.0), .aims_enu = {}};
    for (Eigen::Vector3d& place : world.stations_enu) place += centre;
    const auto path =
        bench::cruising({centre + Eigen::Vector3d(0, 0, 100), {8, 3, 0}}, 0.5, seconds, random);
    for (BearingMeasurement& s : bench::measure(world, {path}, seconds, random)) {
      s.station.append("g").append(std::to_string(group));
      all.push_back(std::move(s));
    }
  }
  std::ranges::stable_sort(all, {}, &BearingMeasurement::utime_us);
  return all;
}

// A silence within an epoch of targets, and one within a round of slews: pending outputs are
// discarded.
TEST(FusionEpoch, NothingOldIsToldAfterASilence) {
  constexpr std::int64_t kSilenceUs = 10'000'000;
  Fusion fusion{FusionConfig{}};
  std::set<std::pair<std::int64_t, std::int64_t>> told;
  std::int64_t silences = 0;
  std::size_t before = 0, after = 0, slews = 0;
  for (BearingMeasurement measurement : many_targets(2.0)) {
    const std::int64_t flown_us = measurement.utime_us - bench::kStartUs;
    measurement.utime_us += silences * kSilenceUs;
    const FusionOutput output = fusion.add(measurement);
    for (const FusedTarget& target : output.targets) {
      EXPECT_LT(measurement.utime_us - target.utime_us, 2'000'000);
      EXPECT_TRUE(told.insert({target.utime_us, target.target_id}).second);
    }
    for (const Slew& slew : output.slews)
      EXPECT_LT(measurement.utime_us - slew.utime_us, 2'000'000);
    (silences == 0 ? before : after) += output.targets.size();
    slews += silences == 0 ? 0 : output.slews.size();
    const bool amidst_epoch = silences == 0 && !output.targets.empty();
    const bool amidst_round = silences == 1 && !output.slews.empty() && flown_us > 1'100'000;
    if (flown_us > 1'000'000 && (amidst_epoch || amidst_round)) ++silences;
  }
  EXPECT_EQ(silences, 2);
  EXPECT_GT(before, 100U);
  EXPECT_GT(after, 200U) << "all are there again, though many rays are parallel by chance";
  EXPECT_GT(slews, 50U);
}

// A round of slews for many stations continues with the bearings of a few: each slew is for the
// time of its creation.
TEST(FusionEpoch, SlewsOfManyStationsAreEachForTheirOwnInstant) {
  Fusion fusion{FusionConfig{}};
  for (int i = 0; i < 200; ++i) {
    fusion.know_station("watcher" + std::to_string(i),
                        {.camera_ecef = test::site().to_ecef({5.0 * i, 50.0, 0.0})});
  }
  int slews = 0;
  std::set<std::string> stations;
  for (const BearingMeasurement& measurement : flight(4.0, 1e-4, 1e-4)) {
    const FusionOutput output = fusion.add(measurement);
    for (const Slew& slew : output.slews) {
      EXPECT_EQ(slew.utime_us, fusion.now_us());
      EXPECT_EQ(slew.effect_utime_us, fusion.now_us() + 150'000);
      stations.insert(slew.station);
      ++slews;
    }
  }
  EXPECT_EQ(stations.size(), 204U);
  EXPECT_GT(slews, 1000);
}

TEST(FusionEpoch, WhomAnOperatorTakesIsSlewedNoMore) {
  Fusion fusion{FusionConfig{}};
  std::map<bool, int> slews;  // of station b, by whether it is commandable
  for (const BearingMeasurement& measurement : flight(4.0, 1e-4, 1e-4)) {
    const bool is_taken = measurement.utime_us > us(2.0);
    fusion.allow_slews("b", !is_taken);
    fusion.allow_slews("nobody", true);
    for (const Slew& slew : fusion.add(measurement).slews) slews[is_taken] += slew.station == "b";
  }
  EXPECT_GT(slews[false], 5);
  EXPECT_EQ(slews[true], 0);
  EXPECT_EQ(fusion.health().stations.size(), 4U);
}

// Each target once per epoch, few with one bearing, and every station is slewed in each round.
TEST(FusionEpoch, ManyTargetsAreToldInTurn) {
  Fusion fusion{FusionConfig{}};
  std::map<std::int64_t, std::vector<std::int64_t>> epochs;
  std::map<std::int64_t, std::set<std::string>> rounds;
  std::map<std::int64_t, int> papers;
  for (const BearingMeasurement& measurement : many_targets(2.0)) {
    const FusionOutput output = fusion.add(measurement);
    EXPECT_LE(output.targets.size(), 10U);
    EXPECT_LE(output.slews.size(), 20U);
    if (measurement.utime_us < bench::kStartUs + 1'000'000) continue;
    for (const FusedTarget& target : output.targets) {
      epochs[target.utime_us].push_back(target.target_id);
    }
    papers[output.targets_paper.empty() ? 0 : output.targets_paper[0].utime_us] +=
        static_cast<int>(output.targets_paper.size());
    for (const Slew& slew : output.slews) rounds[slew.utime_us].insert(slew.station);
  }
  // The first and the last may be incomplete.
  ASSERT_GT(epochs.size(), 10U);
  for (auto epoch = std::next(epochs.begin()); epoch != std::prev(epochs.end()); ++epoch) {
    EXPECT_EQ(epoch->second.size(), static_cast<std::size_t>(kTargets));
    EXPECT_TRUE(std::ranges::is_sorted(epoch->second));
  }
  papers.erase(0);
  ASSERT_GT(papers.size(), 10U);
  for (auto epoch = std::next(papers.begin()); epoch != std::prev(papers.end()); ++epoch) {
    EXPECT_EQ(epoch->second, FusionConfig{}.paper_targets);
  }
  ASSERT_GT(rounds.size(), 5U);
  for (auto round = std::next(rounds.begin()); round != std::prev(rounds.end()); ++round) {
    EXPECT_EQ(round->second.size(), static_cast<std::size_t>(kTargets * kEach));
  }
}

}  // namespace
}  // namespace ols::fusion
