#include "calibration/followed_tracks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "calibration/guidance.h"
#include "tests/unit/calibration/scene.h"

namespace ols::calibration {
namespace {

using test::hill;

constexpr std::int64_t kNoon_us = 1'780'000'000'000'000;
const std::vector<std::string> kNames{"alfa", "bravo"};

// Both look 50 degrees elsewhere than they are taken to.
std::vector<StationPrior> taken() {
  std::vector<StationPrior> stations;
  for (int s = 0; s < 2; ++s) {
    StationModel model = hill();
    model.geometry.position.longitude_rad += s * radians(0.01);
    model.geometry.chain.heading_rad += radians(50.0);
    stations.push_back(test::prior_of(model));
  }
  return stations;
}

StationModel truth(std::size_t station) {
  StationModel model = taken()[station].model;
  model.geometry.chain.heading_rad -= radians(50.0);
  return model;
}

// Where it flies, east-north-up of the first station, by the time after noon.
using Flight = Eigen::Vector3d (*)(double time_s);
Eigen::Vector3d past(double s) { return {-800.0 + 40.0 * s, 1500.0, 400.0}; }
Eigen::Vector3d high(double s) { return {-4000.0 + 230.0 * s, 14000.0, 9000.0}; }
Eigen::Vector3d other(double s) { return {4000.0, 14000.0 - 230.0 * s, 9000.0}; }

FollowedSighting sees(std::size_t station, Flight flight, double time_s, std::int64_t track = 1) {
  FollowedSighting one;
  one.station = station;
  one.boot_id = 7;
  one.track_id = track;
  one.utime_us = kNoon_us + std::llround(1e6 * time_s);
  one.pixel = {650.0, 470.0};
  one.sd_px = 0.3;
  const Eigen::Vector3d ecef = LocalFrame(hill().geometry.position).to_ecef(flight(time_s));
  const StationModel model = truth(station);
  const Eigen::Vector3d there = LocalFrame(model.geometry.position).to_enu(ecef);
  one.reading = reading_towards(model, {there, 1.0}, one.pixel, 1, 1).value();
  return one;
}

// Exposures at 20 Hz; those around each whole second.
void follow(std::vector<FollowedSighting>& all, std::size_t station, Flight flight, int seconds,
            double phase_s, std::int64_t track = 1) {
  for (int s = 1; s <= seconds; ++s) {
    for (const double at_s : {phase_s - 0.05, phase_s}) {
      all.push_back(sees(station, flight, s + at_s, track));
    }
  }
}

Trajectory announced(Flight flight, int seconds) {
  Trajectory trajectory;
  trajectory.sd_m = 10.0;
  const LocalFrame ground(hill().geometry.position);
  for (int s = -2; s <= seconds + 2; ++s) {
    trajectory.points.push_back({kNoon_us + 1'000'000 * s, ground.to_ecef(flight(s - 0.4))});
  }
  return trajectory;
}

std::size_t count(const FollowedObservations& found, Kind kind, const std::string& reference) {
  return static_cast<std::size_t>(std::ranges::count_if(
      found.observations,
      [&](const Observation& one) { return one.kind == kind && one.reference == reference; }));
}

TEST(InstantsOf, AreAtWholeSecondsBetweenTwoExposures) {
  const FollowedSighting exact = sees(0, past, 3.0);
  const Instants found = instants_of({sees(0, past, 3.02), sees(0, past, 2.97)}, taken());
  ASSERT_EQ(found.instants.size(), 1U);
  const Instant& one = found.instants[0];
  EXPECT_EQ(one.utime_us, kNoon_us + 3'000'000);
  EXPECT_NEAR(one.reading.pan.counts, exact.reading.pan.counts, 0.02);
  EXPECT_NEAR(one.reading.tilt.counts, exact.reading.tilt.counts, 0.02);
}

TEST(InstantsOf, AClockThatMayBeOffWidensThem) {
  FollowedSighting before = sees(0, past, 2.97), after = sees(0, past, 3.02);
  before.clock_sd_s = after.clock_sd_s = 0.002;
  // 40 m/s at 1 700 m are 0.023 rad/s: 313 px/s.
  const Instants found = instants_of({before, after}, taken());
  EXPECT_NEAR(found.instants.at(0).sd_px, std::hypot(0.3, 0.62), 0.05);
}

TEST(InstantsOf, WhereTheUnitTurnedRoundItsBacklashIsNotKnown) {
  FollowedSighting before = sees(0, past, 2.97), after = sees(0, past, 3.02);
  before.reading.pan.approach = -1;
  FollowedSighting unknown = sees(0, past, 3.97), next = sees(0, past, 4.02);
  unknown.reading.tilt.approach = next.reading.tilt.approach = 0;
  const Instants found = instants_of({before, after, unknown, next, sees(0, past, 7.0)}, taken());
  EXPECT_TRUE(found.instants.empty());
  EXPECT_EQ(found.unsure, 2U);
  EXPECT_EQ(found.lonely, 1U);
}

TEST(Followed, WhatTwoStationsSeeAtTheSameInstantsIsATrack) {
  std::vector<FollowedSighting> all;
  follow(all, 0, past, 30, 0.02, 3);
  follow(all, 1, past, 30, 0.04, 8);
  const FollowedObservations found =
      followed(instants_of(all, taken()).instants, taken(), kNames, {});
  ASSERT_EQ(found.observations.size(), 60U);
  EXPECT_EQ(count(found, Kind::kTrack, "alfa:3+bravo:8"), 60U);
  for (std::size_t i = 0; i < 60; i += 2) {
    EXPECT_EQ(found.observations[i].utime_us, found.observations[i + 1].utime_us);
  }
}

TEST(Followed, ALostAndFoundTargetIsAnotherTrack) {
  std::vector<FollowedSighting> all;
  follow(all, 0, past, 30, 0.02, 3);
  follow(all, 1, past, 20, 0.04, 8);
  for (int s = 21; s <= 23; ++s) {
    for (const double at_s : {-0.02, 0.03}) all.push_back(sees(1, past, s + at_s, 9));
  }
  const FollowedObservations found =
      followed(instants_of(all, taken()).instants, taken(), kNames, {});
  EXPECT_EQ(found.observations.size(), 40U);
  EXPECT_NE(found.remarks.back().find("3 instants, too few"), std::string::npos);
}

// By a station that does not know its heading, of an aircraft whose positions come late.
TEST(Followed, AnAircraftIsKnownByHowItFlies) {
  std::vector<FollowedSighting> all;
  follow(all, 0, high, 40, 0.02);
  const References references{{"4ca2d6", announced(high, 40)}, {"3c6444", announced(other, 40)}};
  const std::vector<Instant> instants = instants_of(all, taken()).instants;
  const FollowedObservations found = followed(instants, taken(), kNames, references);
  EXPECT_EQ(count(found, Kind::kAircraft, "4ca2d6"), 40U);
  EXPECT_EQ(found.observations.size(), 40U);
  // What flies otherwise is none of them.
  const References others{{"3c6444", announced(other, 40)}};
  EXPECT_TRUE(followed(instants, taken(), kNames, others).observations.empty());
  // Of two that fly alike nobody knows which.
  const References twice{{"a", announced(high, 40)}, {"b", announced(high, 40)}};
  EXPECT_TRUE(followed(instants, taken(), kNames, twice).observations.empty());
}

TEST(Followed, TellsHowManyOfTheTracksAreCompared) {
  std::vector<FollowedSighting> all;
  follow(all, 0, past, 10, 0.02, 3);
  follow(all, 0, past, 10, 0.02, 4);
  follow(all, 1, past, 10, 0.04, 8);
  std::vector<std::pair<std::size_t, std::size_t>> told;
  followed(instants_of(all, taken()).instants, taken(), kNames, {},
           [&](std::size_t done, std::size_t tracks) { told.emplace_back(done, tracks); });
  EXPECT_EQ(told, (std::vector<std::pair<std::size_t, std::size_t>>{{1, 3}, {2, 3}, {3, 3}}));
}

}  // namespace
}  // namespace ols::calibration
