#include "central/tracking/live_tracks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

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

}  // namespace
}  // namespace ols::fusion
