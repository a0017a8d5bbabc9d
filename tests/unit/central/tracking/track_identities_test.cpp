#include "central/tracking/track_identities.h"

#include <gtest/gtest.h>

#include "tests/unit/central/flight.h"

namespace ols::fusion {
namespace {

using namespace test;

Track track_at(const Eigen::Vector3d& p_enu) {
  Track track(TrackFilter(
      {}, kStart, {.p_ecef = site().to_ecef(p_enu), .position_sd_m = 1.0, .velocity_sd_m_s = 1.0}));
  track.state = TrackState::kConfirmed;
  track.last_two_station_us = kStart;
  return track;
}

BearingMeasurement named(std::int64_t track_id, double t_s = 0.0) {
  BearingMeasurement measurement =
      measurement_of(ray_to("a", {0, 0, 0}, path(t_s)), kStart + std::llround(t_s * 1e6));
  measurement.track_id = track_id;
  return measurement;
}

TEST(TrackIdentities, ADeletedTrackIsFoundAgainWhereItMustBe) {
  TrackIdentities identities(true);
  Track first = track_at({0, 300, 50});
  identities.confirm(first, {});
  EXPECT_EQ(first.id, 1);
  identities.keep_deleted(first);
  Track elsewhere = track_at({100, 300, 50}), same = track_at({1, 300, 50});
  identities.confirm(elsewhere, {});
  EXPECT_EQ(elsewhere.id, 2);
  identities.confirm(same, {});
  EXPECT_EQ(same.id, 1);
  identities.keep_deleted(same);
  identities.forget_deleted(kStart + 8'000'000, 7.0);
  Track late = track_at({1, 300, 50});
  identities.confirm(late, {});
  EXPECT_EQ(late.id, 3);
}

TEST(TrackIdentities, OfARecordingThereIsOneObjectWhereverItIs) {
  TrackIdentities identities(false);
  Track first = track_at({0, 300, 50}), next = track_at({500, 300, 50});
  identities.confirm(first, {});
  identities.keep_deleted(first);
  identities.confirm(next, {});
  EXPECT_EQ(next.id, first.id);
}

TEST(TrackIdentities, ALinesIdentityBecomesThatOfItsTarget) {
  TrackIdentities identities(true);
  std::set<std::int64_t> told;
  EXPECT_EQ(identities.identify(named(7), 0.7, told, {}), 0) << "too young";
  const std::int64_t line = identities.identify(named(7, 1.0), 0.7, told, {});
  EXPECT_GT(line, 0);
  EXPECT_TRUE(told.contains(line));
  EXPECT_EQ(identities.identify(named(0, 2.0), 0.7, told, {}), 0) << "not named";
  Track track = track_at({0, 300, 50});
  track.bearings["a"] = {named(7, 1.1)};
  identities.confirm(track, {});
  EXPECT_EQ(track.id, line);
}

TEST(TrackIdentities, AStationsNameFollowsItsTrack) {
  TrackIdentities identities(true);
  std::vector<Track> tracks{track_at({0, 300, 50})};
  identities.confirm(tracks[0], {});
  identities.follow(named(7), tracks[0]);
  EXPECT_EQ(identities.follower(named(7), tracks), &tracks[0]);
  EXPECT_EQ(identities.follower(named(8), tracks), nullptr);
  EXPECT_TRUE(identities.takes(named(7), kStart + 900'000, 1.0, tracks));
  EXPECT_FALSE(identities.takes(named(7), kStart + 1'000'000, 1.0, tracks));
  identities.forget("a");
  EXPECT_EQ(identities.follower(named(7), tracks), nullptr);
}

}  // namespace
}  // namespace ols::fusion
