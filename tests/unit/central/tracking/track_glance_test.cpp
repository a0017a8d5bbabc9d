#include "central/tracking/track_glance.h"

#include <gtest/gtest.h>

#include "central/tracking/local_tracks.h"
#include "central/tracking/track_identities.h"
#include "tests/unit/central/flight.h"

namespace ols::fusion {
namespace {

using Eigen::Vector3d;

using namespace test;

bool may_see(const Vector3d& looks_at, double after_s = 0.0) {
  const Track track(TrackFilter({}, kStart,
                                {.p_ecef = site().to_ecef({0, 300, 50}),
                                 .v_ecef = site().R_ecef_enu() * Vector3d(50, 0, 0),
                                 .position_sd_m = 0.1,
                                 .velocity_sd_m_s = 0.1}));
  const BearingMeasurement measurement =
      measurement_of(ray_to("a", {0, 0, 0}, looks_at), kStart + std::llround(after_s * 1e6));
  const LineOfSight& sight = measurement.sight;
  return summarise_track(track).may_see(measurement, direction_ecef(sight), may_be_off_rad(sight));
}

TEST(TrackGlance, RulesOutWhatLooksElsewhere) {
  EXPECT_TRUE(may_see({0, 300, 50}));
  EXPECT_TRUE(may_see({3, 300, 50}));
  EXPECT_FALSE(may_see({30, 300, 50}));
  EXPECT_FALSE(may_see({0, -300, -50})) << "behind the camera";
}

TEST(TrackGlance, GoesOnWithTheTrack) {
  EXPECT_TRUE(may_see({50, 300, 50}, 1.0));
  EXPECT_FALSE(may_see({0, 300, 50}, 1.0));
}

BearingMeasurement named(std::int64_t track_id, std::int64_t utime_us) {
  BearingMeasurement measurement;
  measurement.station = std::string("a");
  measurement.track_id = track_id;
  measurement.utime_us = utime_us;
  return measurement;
}

TEST(LocalTracks, TheOneThatWasNotHeardOfForLongestGivesWay) {
  LocalTracks local;
  const auto most = static_cast<std::int64_t>(LocalTracks::kOfAStation);
  for (std::int64_t i = 1; i <= most; ++i) local.at(named(i, i)).id = 100 + i;
  local.at(named(1, 1000));  // heard again
  local.at(named(most + 1, 1001));
  EXPECT_EQ(local.size("a"), LocalTracks::kOfAStation);
  ASSERT_NE(local.find(named(1, 0)), nullptr);
  EXPECT_EQ(local.find(named(1, 0))->id, 101);
  EXPECT_EQ(local.find(named(2, 0)), nullptr);
}

TEST(LocalTracks, TwoIdentitiesBecomeOne) {
  LocalTracks local;
  local.at(named(1, 1)).id = 5;
  local.at(named(2, 1)).id = 9;
  local.rename(9, 5);
  EXPECT_EQ(local.find(named(2, 0))->id, 5);
  local.forget("a");
  EXPECT_EQ(local.find(named(1, 0)), nullptr);
}

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
