#include "central/tracking/track_manager.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/central/given_tracks.h"

namespace ols::fusion {
namespace {

using Eigen::Vector3d;
using test::confirm_at;
using test::GivenTracks;
using test::kStart;
using test::sight_of;

const Vector3d kPlace(0.0, 300.0, 50.0), kElsewhere(60.0, 250.0, 80.0);
constexpr std::int64_t kSecondUs = 1'000'000;

TEST(TrackManager, ATrackIsConfirmedOnceItHasAPositionAndMeetsTheCriteria) {
  GivenTracks tracks;
  tracks.worth_confirming = false;
  const std::int64_t now_us = confirm_at(tracks, kPlace);
  ASSERT_EQ(tracks.tracks().size(), 1U);
  EXPECT_EQ(tracks.tracks()[0].state, TrackState::kTentative);
  EXPECT_EQ(tracks.tracks()[0].id, 0);
  tracks.worth_confirming = true;
  const Association last = tracks.add(sight_of(0, kPlace, now_us + 20'000));
  EXPECT_EQ(last.kind, Association::Kind::kTrack);
  EXPECT_EQ(tracks.tracks()[0].state, TrackState::kConfirmed);
  EXPECT_EQ(tracks.tracks()[0].id, 1);
  EXPECT_EQ(tracks.counts().initiated, 1);
  EXPECT_EQ(tracks.counts().confirmed, 1);
}

TEST(TrackManager, OneStationsTrackHasNoPositionAndIsNotConfirmed) {
  GivenTracks tracks;
  tracks.begin_at(kPlace);
  for (int i = 0; i < 20; ++i) tracks.add(sight_of(0, kPlace, kStart + 20'000 * i));
  EXPECT_EQ(tracks.tracks()[0].state, TrackState::kTentative);
  EXPECT_EQ(tracks.tracks()[0].hits.at("a"), 20);
}

TEST(TrackManager, ABearingBesideTheTrackIsRejectedAndCounted) {
  GivenTracks tracks;
  const std::int64_t now_us = confirm_at(tracks, kPlace);
  const Association beside = tracks.add(sight_of(0, kElsewhere, now_us + 20'000));
  EXPECT_EQ(beside.kind, Association::Kind::kRejected);
  EXPECT_EQ(beside.track_id, 1);
  EXPECT_EQ(tracks.tracks()[0].misses, 1);
  EXPECT_EQ(tracks.counts().rejected, 1);
}

// A station converts the time of each bearing by itself; behind a rolling shutter each row has its
// own.
TEST(TrackManager, BearingsOfOneExposureDifferInTimeByMicrosecondsOrSomeRows) {
  GivenTracks tracks;
  const std::int64_t now_us = confirm_at(tracks, kPlace) + 20'000;
  tracks.add(sight_of(0, kPlace, now_us));
  for (const std::int64_t off_us : {-1500, -1, 0, 1, 1500}) {
    EXPECT_TRUE(tracks.tracks()[0].has_taken(sight_of(0, kPlace, now_us + off_us))) << off_us;
    EXPECT_FALSE(tracks.tracks()[0].has_taken(sight_of(1, kPlace, now_us + off_us))) << off_us;
  }
  for (const std::int64_t off_us : {-8000, 8000}) {
    EXPECT_FALSE(tracks.tracks()[0].has_taken(sight_of(0, kPlace, now_us + off_us))) << off_us;
  }
}

TEST(TrackManager, ADuplicateOfAConfirmedTrackIsDeleted) {
  GivenTracks tracks;
  std::int64_t now_us = confirm_at(tracks, kPlace);
  now_us = confirm_at(tracks, kPlace, now_us);
  ASSERT_EQ(tracks.tracks().size(), 2U);
  EXPECT_EQ(tracks.tracks()[1].state, TrackState::kDeleted);
  tracks.advance(now_us);
  ASSERT_EQ(tracks.tracks().size(), 1U);
  EXPECT_EQ(tracks.tracks()[0].id, 1);
  EXPECT_EQ(tracks.counts().deleted, 1);
  confirm_at(tracks, kElsewhere, now_us);
  ASSERT_EQ(tracks.tracks().size(), 2U);
  EXPECT_EQ(tracks.tracks()[1].id, 2) << "what stands elsewhere is another object";
}

TEST(TrackManager, ATrackCoastsWithoutTwoStationsAndComesBackWithTwo) {
  GivenTracks tracks;
  const std::int64_t seen_us = confirm_at(tracks, kPlace);
  const auto coast_us = std::llround(TrackManagerConfig{}.coast_s * 1e6);
  tracks.advance(seen_us + coast_us);
  EXPECT_EQ(tracks.tracks()[0].state, TrackState::kConfirmed);
  const std::int64_t later_us = seen_us + coast_us + 1000;
  tracks.advance(later_us);
  EXPECT_EQ(tracks.tracks()[0].state, TrackState::kCoasting);
  tracks.add(sight_of(0, kPlace, later_us));
  EXPECT_EQ(tracks.tracks()[0].state, TrackState::kCoasting) << "one station alone";
  tracks.add(sight_of(1, kPlace, later_us));
  EXPECT_EQ(tracks.tracks()[0].state, TrackState::kConfirmed);
  EXPECT_EQ(tracks.counts().confirmed, 1) << "it was all the time";
}

TEST(TrackManager, ATrackThatIsLostIsDeletedAndFoundAgainUnderItsIdentity) {
  GivenTracks tracks;
  const std::int64_t seen_us = confirm_at(tracks, kPlace);
  tracks.lost = true;
  tracks.advance(seen_us + kSecondUs / 10);
  EXPECT_EQ(tracks.tracks().size(), 1U) << "only what coasts can be lost";
  tracks.advance(seen_us + kSecondUs);
  EXPECT_TRUE(tracks.tracks().empty());
  EXPECT_EQ(tracks.counts().deleted, 1);
  tracks.lost = false;
  confirm_at(tracks, kPlace, seen_us + kSecondUs);
  ASSERT_EQ(tracks.tracks().size(), 1U);
  EXPECT_EQ(tracks.tracks()[0].id, 1);
}

TEST(TrackManager, ATentativeTrackIsDeletedByItsOwnCriterion) {
  GivenTracks tracks;
  tracks.begin_at(kPlace);
  tracks.lost = true;
  tracks.advance(kStart + kSecondUs);
  EXPECT_EQ(tracks.tracks().size(), 1U);
  tracks.tentative_lost = true;
  tracks.advance(kStart + kSecondUs);
  EXPECT_TRUE(tracks.tracks().empty());
}

// Two rays that miss by more than their stations declare: what they taught is wrong, too.
TEST(TrackManager, AnInconsistentPairIsDeletedWithWhatItTaught) {
  FilterConfig strict;
  strict.two_stations_nis = 8.0;
  GivenTracks tracks;
  tracks.begin_at(kPlace);
  tracks.exchange(0, Track(TrackFilter(strict, kStart,
                                       {.p_ecef = test::site().to_ecef(kPlace),
                                        .position_sd_m = 30.0,
                                        .velocity_sd_m_s = 20.0})));
  std::int64_t now_us = kStart;
  for (int i = 0; i < 60; ++i, now_us += 100'000) {
    for (const std::size_t k : {0U, 1U}) {
      BearingMeasurement measurement = sight_of(k, kPlace - Vector3d(30.0, 0.0, 0.0), now_us);
      measurement.sight.covariance_systematic = Eigen::Matrix2d::Identity() * 1e-6;
      measurement.sight.direction.elevation_rad += k == 0 ? 4e-3 : 0.0;
      tracks.add(measurement);
    }
  }
  const double taught = tracks.errors().noise_scale("a");
  ASSERT_NE(taught, BiasModel().noise_scale("a"));
  tracks.advance(now_us);
  EXPECT_TRUE(tracks.tracks().empty());
  EXPECT_EQ(tracks.errors().noise_scale("a"), BiasModel().noise_scale("a"));
}

TEST(TrackManager, KeepsTheBearingsOfItsMemoryInOrderOfTime) {
  GivenTracks tracks;
  tracks.begin_at(kPlace);
  for (int i = 0; i < 200; ++i) tracks.add(sight_of(0, kPlace, kStart + 20'000 * (i ^ 1)));
  const auto& kept = tracks.tracks()[0].bearings.at("a");
  EXPECT_TRUE(std::ranges::is_sorted(kept, {}, &BearingMeasurement::utime_us));
  const std::int64_t span_us = kept.back().utime_us - kept.front().utime_us;
  EXPECT_GE(span_us, kSecondUs);
  EXPECT_LE(span_us, kSecondUs + 16 * 20'000) << "removed in batches";
}

TEST(TrackManager, TellsHowFarABearingIsOffTheNearestConfirmedTrack) {
  GivenTracks tracks;
  tracks.worth_confirming = false;
  std::int64_t now_us = confirm_at(tracks, kPlace);
  EXPECT_FALSE(tracks.off_nearest(sight_of(0, kPlace, now_us)));
  tracks.worth_confirming = true;
  tracks.add(sight_of(0, kPlace, now_us));
  now_us = confirm_at(tracks, kElsewhere, now_us);
  for (const Vector3d& place : {kPlace, kElsewhere}) {
    BearingMeasurement high = sight_of(0, place, now_us);
    high.sight.direction.elevation_rad += 0.01;
    const auto off = tracks.off_nearest(high);
    ASSERT_TRUE(off);
    EXPECT_NEAR(off->x(), 0.0, 1e-3);
    EXPECT_NEAR(off->y(), -0.01, 1e-3) << "predicted minus measured";
  }
}

TEST(TrackManager, ABearingIsOffNoTrackThatIsBehindItsCamera) {
  GivenTracks tracks;
  const std::int64_t now_us = confirm_at(tracks, kPlace);
  const Vector3d north(0.0, 1.0, 0.0);
  const auto looking_north = [&](const Vector3d& from) {
    const Ray ray = test::ray_to("e", from, from + 100.0 * north, 1e-4);
    return tracks.off_nearest(test::measurement_of(ray, now_us)).has_value();
  };
  EXPECT_TRUE(looking_north(kPlace - 0.5 * north));
  EXPECT_FALSE(looking_north(kPlace + 0.5 * north));
}

TEST(TrackManager, ClearedItForgetsTracksErrorsAndCounts) {
  GivenTracks tracks;
  confirm_at(tracks, kPlace);
  tracks.keep_unassociated(sight_of(0, kElsewhere, kStart));
  tracks.clear_tracks();
  EXPECT_TRUE(tracks.tracks().empty());
  EXPECT_TRUE(tracks.unassociated().stations().empty());
  EXPECT_EQ(tracks.counts().initiated, 0);
  confirm_at(tracks, kPlace);
  EXPECT_NE(tracks.tracks().at(0).id, 1) << "identities are not given again";
}

TEST(TrackManager, ALocalTrackIsTakenWhileItsBearingsAreUsed) {
  GivenTracks tracks;
  std::int64_t now_us = confirm_at(tracks, kPlace);
  BearingMeasurement measurement = sight_of(0, kPlace, now_us += 20'000);
  measurement.track_id = 5;
  EXPECT_FALSE(tracks.takes(measurement, now_us, 1.0));
  tracks.add(measurement);
  EXPECT_TRUE(tracks.takes(measurement, now_us, 1.0));
  EXPECT_FALSE(tracks.takes(measurement, now_us + 2 * kSecondUs, 1.0));
  tracks.forget_station("a");
  EXPECT_FALSE(tracks.takes(measurement, now_us, 1.0));
}

}  // namespace
}  // namespace ols::fusion
