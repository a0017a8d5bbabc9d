#include "central/tracking/live_tracks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <span>

#include "dev/estimators/bearing_world.h"
#include "tests/unit/central/scene.h"

namespace ols::fusion {
namespace {

// Four stations see one object; the first two also follow one each by a track id, whose rays
// intersect for a moment. All are twice as noisy as they state.
std::vector<BearingMeasurement> with_a_ghost(double seconds) {
  constexpr double kTwice = 2.0;
  bench::WorldConfig world{.stations_enu = test::square(), .aims_enu = {}};
  world.noise_rad = kTwice * 3e-4;
  std::mt19937_64 random(11);
  std::vector<BearingMeasurement> all;
  const auto path = [&](const Eigen::Vector3d& from, double climb_m_s) {
    return bench::cruising({from, {0.0, 0.0, climb_m_s}}, 1e-6, seconds, random);
  };
  const bench::Path paths[] = {path({60, 60, 150}, 0.0), path({0, 0, 80}, 0.0),
                               path({20, 10, 79}, 1.0)};
  for (int i = 0; i < 3; ++i) {
    for (BearingMeasurement& s : bench::measure(world, {paths[i]}, seconds, random)) {
      if (i == 1 && s.station != "s0") continue;
      if (i == 2 && s.station != "s1") continue;
      s.track_id = i == 0 ? 0 : 1;
      s.sight.covariance_white /= kTwice * kTwice;
      all.push_back(std::move(s));
    }
  }
  std::ranges::stable_sort(all, {}, &BearingMeasurement::utime_us);
  return all;
}

TEST(LiveTracks, ADeletedTrackTakesNothingThatAnotherOneHasTaught) {
  LiveTracks live{TrackManagerConfig{}};
  std::int64_t deleted = 0;
  for (const BearingMeasurement& measurement : with_a_ghost(8.0)) {
    live.add(measurement);
    live.advance(measurement.utime_us);
    if (measurement.utime_us < bench::kStartUs + 2'000'000) continue;
    for (const char* station : {"s0", "s1", "s2", "s3"}) {
      ASSERT_GT(live.errors().noise_scale(station), 2.0)
          << station << ' ' << measurement.utime_us - bench::kStartUs;
    }
    deleted = live.counts().deleted;
  }
  EXPECT_GE(deleted, 1);
  EXPECT_EQ(std::ranges::count_if(live.tracks(), is_established), 1);
}

TEST(LiveTracks, TwoStationsConfirmATrackByThatManyHitsOfEach) {
  TrackManagerConfig config;
  config.confirm_pair_hits = 25;
  config.confirm_s = 0.1;
  LiveTracks live(config);
  const auto square = test::square();
  bench::WorldConfig world{.stations_enu = {square[0], square[1]}, .aims_enu = {}};
  std::mt19937_64 random(5);
  const bench::Path path = bench::cruising({{60, 60, 150}, {3.0, 0.0, 0.0}}, 1e-6, 3.0, random);
  for (const BearingMeasurement& measurement : bench::measure(world, {path}, 3.0, random)) {
    live.add(measurement);
    live.advance(measurement.utime_us);
    if (!live.tracks().empty() && is_established(live.tracks().front())) break;
  }
  ASSERT_EQ(live.tracks().size(), 1U);
  ASSERT_TRUE(is_established(live.tracks().front()));
  const auto& hits = live.tracks().front().hits;
  ASSERT_EQ(hits.size(), 2U);
  EXPECT_EQ(std::min(hits.begin()->second, hits.rbegin()->second), 25);
}

// The bearing of the object comes second: one by one, the first in the gate would be taken.
TEST(LiveTracks, OfAnImagesBearingsATrackTakesTheNearest) {
  LiveTracks live{TrackManagerConfig{}};
  bench::WorldConfig world{.stations_enu = test::square(), .aims_enu = {}};
  std::mt19937_64 random(7);
  const bench::Path path = bench::cruising({{60, 60, 150}, {3.0, 0.0, 0.0}}, 1e-6, 3.0, random);
  const auto all = bench::measure(world, {path}, 3.0, random);
  int images = 0, right = 0;
  for (const BearingMeasurement& measurement : all) {
    BearingMeasurement beside = measurement;
    beside.sight.direction.elevation_rad += 1.3e-3;
    const BearingMeasurement image[] = {beside, measurement};
    const bool has_two =
        measurement.station == "s0" && measurement.utime_us > bench::kStartUs + 2'000'000;
    const auto fates = live.add(std::span(image).subspan(has_two ? 0 : 1), true);
    live.advance(measurement.utime_us);
    if (!has_two) continue;
    ++images;
    right += fates[1].kind == Association::Kind::kTrack ? 1 : 0;
  }
  EXPECT_GT(images, 20);
  EXPECT_GE(right, 0.85 * images) << "noise makes the other the nearest in a few of them";
}

// Two objects in one plane with both stations, for four seconds.
TEST(LiveTracks, TwoStationsConfirmNothingWhileTheirObjectsMayBePairedInTwoWays) {
  constexpr double kPartS = 4.0, kEndS = 9.0;
  bench::WorldConfig world{.stations_enu = {{-100, 0, 0}, {100, 0, 0}}, .aims_enu = {}};
  world.tracklets = true;
  world.breaks_per_s = 0.0;
  world.rate_hz = 15.0;
  std::mt19937_64 random(3);
  bench::Path left, right;
  for (int k = 0; k < (kEndS + 1.0) * bench::kPathHz; ++k) {
    const double climbed = 4.0 * std::max(0.0, k / bench::kPathHz - kPartS);
    left.push_back({{-20.0, 300.0, 100.0 + climbed}, {}});
    right.push_back({{20.0, 300.0, 100.0}, {}});
  }
  LiveTracks live{TrackManagerConfig{}};
  bool was_ambiguous = false;
  for (const BearingMeasurement& m : bench::measure(world, {left, right}, kEndS, random)) {
    live.add(m);
    live.advance(m.utime_us);
    was_ambiguous = was_ambiguous || live.is_ambiguous();
    const bool together = m.utime_us < bench::kStartUs + static_cast<std::int64_t>(kPartS * 1e6);
    if (together) {
      ASSERT_EQ(live.counts().confirmed, 0);
    }
  }
  EXPECT_TRUE(was_ambiguous);
  EXPECT_FALSE(live.is_ambiguous());
  ASSERT_EQ(std::ranges::count_if(live.tracks(), is_established), 2);
  for (const Track& track : live.tracks()) {
    const double x = std::abs(test::site().to_enu(track.filter.position()).x());
    EXPECT_NEAR(x, 20.0, 3.0);
  }
}

// Three stations with detectors and one object: until kAllS two of them see it, then one. All look
// there; who does not see it sees another one, elsewhere.
std::vector<BearingMeasurement> partly_seen(double all_s, double end_s) {
  const auto square = test::square();
  bench::WorldConfig world{.stations_enu = {square[0], square[1], square[2]}, .aims_enu = {}};
  world.tracklets = true;
  world.breaks_per_s = 0.0;
  world.rate_hz = 15.0;
  std::mt19937_64 random(7);
  std::vector<BearingMeasurement> all;
  for (const bool is_it : {true, false}) {
    const Eigen::Vector3d from = is_it ? Eigen::Vector3d(0, 0, 150) : Eigen::Vector3d(0, 0, 900);
    const bench::Path path = bench::cruising({from, {2.0, 0.0, 0.0}}, 1e-6, end_s, random);
    for (BearingMeasurement& m : bench::measure(world, {path}, end_s, random)) {
      const bool is_late = m.utime_us >= bench::kStartUs + static_cast<std::int64_t>(all_s * 1e6);
      const bool sees_it = m.station == "s0" || (m.station == "s1" && !is_late);
      if (sees_it != is_it) continue;
      m.track_id = is_it ? 1 : 2;
      all.push_back(std::move(m));
    }
  }
  std::ranges::stable_sort(all, {}, &BearingMeasurement::utime_us);
  return all;
}

TEST(LiveTracks, MissesDelayTheConfirmationAndCountOnlyWhileTwoOthersSeeTheTarget) {
  constexpr double kAllS = 4.0, kEndS = 5.5;
  TrackManagerConfig config;
  config.confirm_pair_hits = 2;
  config.confirm_s = 0.1;
  LiveTracks live(config);
  const Eigen::Vector3d there = test::site().to_ecef({5.0, 0.0, 150.0});
  bool was_confirmed = false;
  for (const BearingMeasurement& m : partly_seen(kAllS, kEndS)) {
    live.know_view(m.station, test::direction_to(m.sight.origin_ecef, there), 1.0, m.utime_us);
    live.add(m);
    live.advance(m.utime_us);
    const auto sure = std::ranges::find_if(live.tracks(), is_established);
    if (sure == live.tracks().end() || was_confirmed) continue;
    was_confirmed = true;
    EXPECT_GE(sure->existence.probability(), 0.95);
  }
  ASSERT_TRUE(was_confirmed);
  const auto low = [](const Track& track) {
    return is_established(track) && test::site().to_enu(track.filter.position()).z() < 400.0;
  };
  EXPECT_EQ(std::ranges::count_if(live.tracks(), low), 1) << "one station alone still sees it";
}

// Five minutes of four stations that have clutter: when the confirmed tracks began that were more
// than 20 m from the object, and whether it was found.
struct Found {
  std::set<std::int64_t> ghosts;
  bool target = false;
};
Found found_in_clutter(double chance_pairs_a_day) {
  constexpr double kEndS = 300.0;
  bench::WorldConfig world{.stations_enu = test::square(), .aims_enu = {}};
  world.tracklets = true;
  world.rate_hz = 10.0;
  world.false_per_frame = 2.0;
  std::mt19937_64 random(5);
  const bench::Path path = bench::cruising({{-60, 80, 90}, {1.0, 0.0, 0.0}}, 0.05, kEndS, random);
  LiveTracks live{TrackManagerConfig{.chance_pairs_a_day = chance_pairs_a_day}};
  Found found;
  for (const BearingMeasurement& m : bench::measure(world, {path}, kEndS, random)) {
    live.add(m);
    live.advance(m.utime_us);
    const double time_s = 1e-6 * static_cast<double>(m.utime_us - bench::kStartUs);
    for (const Track& track : live.tracks()) {
      if (!is_established(track)) continue;
      const Eigen::Vector3d there = test::site().to_enu(track.filter.position());
      const bool is_it = (there - bench::at(path, time_s).p_enu).norm() < 20.0;
      if (!is_it) found.ghosts.insert(track.initiated_us);
      found.target = found.target || is_it;
    }
  }
  return found;
}

TEST(LiveTracks, AgreementOfTwoStationsByChanceIsNoTarget) {
  EXPECT_GE(found_in_clutter(1e9).ghosts.size(), 1U) << "else this shows nothing";
  const Found found = found_in_clutter(TrackManagerConfig{}.chance_pairs_a_day);
  EXPECT_EQ(found.ghosts.size(), 0U);
  EXPECT_TRUE(found.target) << "the delay ends";
}

}  // namespace
}  // namespace ols::fusion
