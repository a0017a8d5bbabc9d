#include "central/fusion/slew_planner.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "tests/unit/central/flight.h"

namespace ols::fusion {
namespace {

using Eigen::Vector3d;
using test::kStart;
using test::path;
using test::site;

Track track_of_flight(std::int64_t id, double seconds) {
  Track track(TrackFilter(
      {}, kStart,
      {.p_ecef = site().to_ecef(path(0.0)), .position_sd_m = 100.0, .velocity_sd_m_s = 50.0}));
  BiasModel errors;
  for (const BearingMeasurement& s : test::flight(seconds, 1e-4))
    test::feed(track.filter, s, errors);
  track.id = id;
  track.state = TrackState::kConfirmed;
  track.last_two_station_us = track.filter.utime_us();
  return track;
}

SlewStation station_at(const std::string& id, const Vector3d& p_enu, std::int64_t follows = 0) {
  return {id, {.camera_ecef = site().to_ecef(p_enu)}, follows};
}

std::vector<Slew> plan(SlewPlanner& planner, std::int64_t now_us,
                       const std::vector<SlewStation>& stations, const std::vector<Track>& tracks) {
  SlewRound round{.now_us = now_us};
  for (const SlewStation& station : stations) ++round.seen_by[station.follows];
  planner.allocate(round, stations, tracks);
  return planner.plan(round, stations, tracks);
}

double off_rad(const Slew& slew, const Vector3d& from_enu, const Vector3d& to_enu) {
  const auto expected = test::direction_to(site().to_ecef(from_enu), site().to_ecef(to_enu));
  return angle_between(enu_from_azimuth_elevation(slew.direction),
                       enu_from_azimuth_elevation(expected));
}

TEST(SlewPlanner, LeadsByTheStationsOwnLatency) {
  const std::vector<Track> tracks = {track_of_flight(1, 3.0)};
  const std::int64_t now_us = tracks[0].filter.utime_us();
  SlewPlanner planner;
  SlewStation slow = station_at("slow", {0, 0, 10}, 1);
  slow.traits.latency_s = 0.4;
  const auto slews = plan(planner, now_us, {station_at("quick", {0, 0, 10}, 1), slow}, tracks);
  ASSERT_EQ(slews.size(), 2U);
  EXPECT_EQ(slews[0].effect_utime_us, now_us + 150'000);
  EXPECT_EQ(slews[1].effect_utime_us, now_us + 500'000);
  for (const Slew& slew : slews) {
    const double t_s = 1e-6 * static_cast<double>(slew.effect_utime_us - kStart);
    EXPECT_LT(off_rad(slew, {0, 0, 10}, path(t_s)), 2e-3);
    EXPECT_EQ(slew.lease_s, SlewConfig{}.lease_s);
  }
}

TEST(SlewPlanner, TheOperatorComesFirst) {
  const std::vector<Track> tracks = {track_of_flight(1, 2.0)};
  SlewPlanner planner;
  SlewStation held = station_at("held", {0, 0, 0});
  held.traits.commandable = false;
  EXPECT_TRUE(plan(planner, tracks[0].filter.utime_us(), {held}, tracks).empty());
}

TEST(SlewPlanner, WhoSeesNothingHelpsWhereTheFewestLook) {
  std::vector<Track> tracks = {track_of_flight(1, 2.0), track_of_flight(2, 2.0)};
  SlewPlanner planner;
  const std::vector<SlewStation> stations = {
      station_at("a", {0, 0, 0}, 1), station_at("b", {9, 0, 0}, 1), station_at("c", {0, 9, 0}, 2),
      station_at("d", {9, 9, 0})};
  const auto slews = plan(planner, tracks[0].filter.utime_us(), stations, tracks);
  ASSERT_EQ(slews.size(), 4U);
  EXPECT_EQ(slews[0].target_id, 1);
  EXPECT_EQ(slews[2].target_id, 2);
  EXPECT_EQ(slews[3].target_id, 2);
}

// No slew that a station would refuse: across the zenith the azimuth rate is unlimited.
TEST(SlewPlanner, NoTargetIsTooNearOrTooUnsureForAStationsLimits) {
  StationTraits station = station_at("a", {0, 0, 0}).traits;
  double fastest = 0.0;
  for (int i = -100; i <= 100; ++i) {
    for (const double sd_m : {0.1, 1e6}) {
      KinematicState target;
      target.mean.head<3>() = site().to_ecef({0.15 * i, 3.0, 60.0});
      target.mean.segment<3>(3) = site().R_ecef_enu() * Vector3d(40.0, 0.0, 0.0);
      target.covariance.diagonal().head<3>().setConstant(sd_m * sd_m);
      const Slew slew = slew_to(target, station, {});
      EXPECT_LE(std::abs(slew.azimuth_rate_rad_s), kSlewRateLimit_rad_s);
      EXPECT_LE(std::abs(slew.elevation_rate_rad_s), kSlewRateLimit_rad_s);
      EXPECT_LE(slew.direction_sd_rad, kPi);
      fastest = std::max(fastest, std::abs(slew.azimuth_rate_rad_s));
    }
  }
  EXPECT_EQ(fastest, kSlewRateLimit_rad_s);
}

TEST(SlewPlanner, ASlowStationIsLedByNoMoreThanItAccepts) {
  const std::vector<Track> tracks = {track_of_flight(1, 3.0)};
  const std::int64_t now_us = tracks[0].filter.utime_us();
  SlewPlanner planner;
  SlewStation slow = station_at("slow", {0, 0, 10}, 1);
  slow.traits.latency_s = 1.9;
  const auto slews = plan(planner, now_us, {slow}, tracks);
  ASSERT_EQ(slews.size(), 1U);
  EXPECT_LT(slews[0].effect_utime_us - now_us, std::llround(1e6 * kSlewLead_s));
  EXPECT_GT(slews[0].effect_utime_us - now_us, std::llround(0.8e6 * kSlewLead_s));
}

TEST(SlewPlanner, WhoDoesNotKnowWhereItStandsStillGetsADirection) {
  const std::vector<Track> tracks = {track_of_flight(1, 3.0)};
  SlewPlanner planner({.coast_s = 60.0, .dwell_s = 1e-4});
  SlewStation lost = station_at("lost", {0, 0, 10});
  lost.traits.camera_sd_enu_m.setConstant(1e6);
  lost.traits.field_of_view_rad = 2e-4;
  double farthest = 0.0;
  for (int i = 0; i < 3000; ++i) {
    const std::int64_t now_us = tracks[0].filter.utime_us() + i * 1000;
    const auto slews = plan(planner, now_us, {lost}, tracks);
    ASSERT_EQ(slews.size(), 1U);
    const auto target = tracks[0].filter.at(slews[0].effect_utime_us);
    const double off_rad =
        angle_between(enu_from_azimuth_elevation(slews[0].direction),
                      enu_from_azimuth_elevation(slew_to(target, lost.traits, {}).direction));
    ASSERT_LT(off_rad, 6e-3) << i;  // 10000 points of half a view each
    farthest = std::max(farthest, off_rad);
  }
  EXPECT_GT(farthest, 5e-3);
}

// "Now" is a median of stamps and may fall back by less than a second unnoticed.
TEST(SlewPlanner, ASearchStaysADirectionWhenNowFallsBack) {
  std::vector<Track> tracks = {track_of_flight(1, 3.0)};
  BiasModel errors;
  test::move_on(tracks[0].filter, tracks[0].filter.utime_us() + 1'900'000, errors);
  const std::int64_t now_us = tracks[0].filter.utime_us();
  SlewPlanner planner({.coast_s = 60.0});
  SlewStation narrow = station_at("b", {0, 0, 0});
  narrow.traits.field_of_view_rad = 0.004;
  plan(planner, now_us, {narrow}, tracks);
  const auto slews = plan(planner, now_us - 850'000, {narrow}, tracks);
  ASSERT_EQ(slews.size(), 1U);
  EXPECT_TRUE(std::isfinite(slews[0].direction.azimuth_rad));
  EXPECT_TRUE(std::isfinite(slews[0].direction.elevation_rad));
}

CueRay ray_of_a(const Vector3d& from, const Vector3d& toward) {
  return {"a", 1, kStart, site().to_ecef(from), (site().R_ecef_enu() * toward).normalized()};
}

// Another object on the same station's ray is searched for from the beginning.
TEST(SlewPlanner, ASecondLookAlongARayBeginsAnew) {
  SlewPlanner used, fresh;
  const std::vector<SlewStation> stations = {station_at("b", {400, 0, 0})};
  SlewRound round{.now_us = kStart,
                  .ray = ray_of_a({0, -400, 0}, {0.1, 1.0, 0.0}),
                  .prior = {400.0, 100.0},
                  .shares = {{"b", {0, 1}}}};
  static_cast<void>(used.plan(round, stations, {}));
  round.now_us = kStart + 30'000'000;
  round.ray = ray_of_a({0, -400, 0}, {-0.3, 1.0, 0.1});
  round.ray->utime_us = round.now_us;
  round.ray->track_id = 2;
  const auto again = used.plan(round, stations, {}), first = fresh.plan(round, stations, {});
  ASSERT_EQ(again.size(), 1U);
  ASSERT_EQ(first.size(), 1U);
  EXPECT_EQ(again[0].direction.azimuth_rad, first[0].direction.azimuth_rad);
  EXPECT_EQ(again[0].direction.elevation_rad, first[0].direction.elevation_rad);
}

// A target is likeliest where the stations are placed to see it.
TEST(SlewPlanner, ASearchAlongARayBeginsWhereItPassesTheStations) {
  SlewPlanner planner;
  const std::vector<SlewStation> stations = {station_at("b", {400, 0, 0}),
                                             station_at("c", {-400, 0, 0})};
  SlewRound round{.now_us = kStart,
                  .ray = ray_of_a({0, -400, 0}, {0.1, 1.0, 0.0}),
                  .prior = {400.0, 100.0},
                  .shares = {{"b", {0, 2}}, {"c", {1, 2}}}};
  const auto slews = planner.plan(round, stations, {});
  ASSERT_EQ(slews.size(), 2U);
  for (const Slew& slew : slews) {
    const Vector3d camera(slew.station == "b" ? 400 : -400, 0, 0);
    const Vector3d begin(40, 0, 0);
    const Vector3d line = enu_from_azimuth_elevation(slew.direction);
    EXPECT_LT(angle_between(line, begin - camera), 0.02) << slew.station;
    EXPECT_EQ(slew.target_id, 0);
    EXPECT_NEAR(slew.line.norm(), 1.0, 1e-9);
    EXPECT_LE(std::abs(slew.azimuth_rate_rad_s), kSlewRateLimit_rad_s);
  }
}

// There is no position: the others search along the only ray, from end to end.
TEST(SlewPlanner, SearchesAlongARayWithinItsPlane) {
  SlewPlanner planner;
  const Vector3d from(0, 0, 0), camera(400, 0, 0);
  const Vector3d toward(0.0, 0.9, 0.2);
  const std::vector<SlewStation> stations = {station_at("a", from), station_at("b", camera)};
  double nearest = 10.0, farthest = 0.0;
  for (int i = 0; i < 2000; ++i) {
    SlewRound round{.now_us = kStart + i * 100'000,
                    .bearing_only_stations = {"a"},
                    .ray = ray_of_a(from, toward)};
    const auto slews = planner.plan(round, stations, {});
    ASSERT_EQ(slews.size(), 1U);  // not for the one that sees it
    EXPECT_EQ(slews[0].station, "b");
    EXPECT_EQ(slews[0].target_id, 0);
    const Vector3d line = enu_from_azimuth_elevation(slews[0].direction);
    const Vector3d normal = (camera - from).cross(toward).normalized();
    EXPECT_NEAR(line.dot(normal), 0.0, 1e-3);
    const double angle = angle_between(line, from - camera);
    nearest = std::min(nearest, angle);
    farthest = std::max(farthest, angle);
  }
  EXPECT_LT(nearest, 0.1);
  EXPECT_GT(farthest, 1.3);
}

// Another ray is another search, from its own beginning.
TEST(SlewPlanner, AnotherRayBeginsTheSearchAnew) {
  SlewPlanner planner;
  const SlewStation b = station_at("b", {400, 0, 0});
  SlewRound round{.now_us = kStart, .ray = ray_of_a({0, -400, 0}, {0.0, 1.0, 0.1})};
  const Slew first = planner.plan(round, std::vector{b}, {}).at(0);
  round.now_us += 5'000'000;
  EXPECT_GT(angle_between(
                enu_from_azimuth_elevation(planner.plan(round, std::vector{b}, {})[0].direction),
                enu_from_azimuth_elevation(first.direction)),
            0.1);
  round.ray->station = "c";
  EXPECT_LT(angle_between(
                enu_from_azimuth_elevation(planner.plan(round, std::vector{b}, {})[0].direction),
                enu_from_azimuth_elevation(first.direction)),
            1e-3);
}

TEST(SlewPlanner, IsNoSurerThanTheStationsPlaceIsKnown) {
  const std::vector<Track> tracks = {track_of_flight(1, 3.0)};
  const KinematicState target = tracks[0].filter.at(tracks[0].filter.utime_us());
  StationTraits station = station_at("a", {0, 0, 10}).traits;
  const double sure_rad = slew_to(target, station, {}).direction_sd_rad;
  station.camera_sd_enu_m = {3.0, 3.0, 3.0};
  const double range_m = (target.mean.head<3>() - station.camera_ecef).norm();
  EXPECT_NEAR(slew_to(target, station, {}).direction_sd_rad, std::hypot(sure_rad, 3.0 / range_m),
              1e-9);
  station.camera_sd_enu_m = {0.0, 0.0, 3.0};  // seen foreshortened from below, and in one axis only
  const double elevation_rad = slew_to(target, station, {}).direction.elevation_rad;
  EXPECT_NEAR(slew_to(target, station, {}).direction_sd_rad,
              std::hypot(sure_rad, 3.0 * std::cos(elevation_rad) / range_m / std::sqrt(2.0)), 1e-9);
}

// A camera that has to cross its search area at each step would never see anything.
TEST(SlewPlanner, ASearchGoesOnByStepsOfAUnitAndLeavesNoGap) {
  EXPECT_EQ(spiral_point(0), Eigen::Vector2d::Zero());
  std::vector<Eigen::Vector2d> points = {spiral_point(0)};
  for (int k = 1; k < 1000; ++k) {
    points.push_back(spiral_point(k));
    EXPECT_LT(
        (points[static_cast<std::size_t>(k)] - points[static_cast<std::size_t>(k) - 1]).norm(),
        k < 10 ? 1.4 : 1.1)
        << k;
  }
  const double reach = spiral_point(999).norm();
  for (double x = -reach; x < reach; x += 0.1) {
    for (double y = -reach; y < reach; y += 0.1) {
      if (std::hypot(x, y) > reach - 1.0) continue;
      const auto near = [&](const Eigen::Vector2d& p) {
        return (p - Eigen::Vector2d(x, y)).norm() < 0.85;
      };
      EXPECT_TRUE(std::ranges::any_of(points, near)) << x << ", " << y;
    }
  }
}

TEST(SlewPlanner, AnUnsureDirectionIsSearchedInASpiral) {
  std::vector<Track> tracks = {track_of_flight(1, 2.0)};
  BiasModel errors;
  test::move_on(tracks[0].filter, tracks[0].filter.utime_us() + 1'900'000, errors);
  const std::int64_t now_us = tracks[0].filter.utime_us();
  SlewPlanner planner({.coast_s = 60.0});
  SlewStation narrow = station_at("b", {0, 0, 0});
  narrow.traits.field_of_view_rad = 0.004;
  double spread = 0.0, sd = 0.0;
  const auto first = plan(planner, now_us, {narrow}, tracks).at(0);
  for (int i = 1; i < 300; ++i) {
    const auto slew = plan(planner, now_us + i * 1000, {narrow}, tracks).at(0);
    sd = slew.direction_sd_rad;
    spread = std::max(spread, angle_between(enu_from_azimuth_elevation(slew.direction),
                                            enu_from_azimuth_elevation(first.direction)));
  }
  EXPECT_GT(sd, 0.004);
  // By now it has been led on with the target by less than that, at most a step or two more.
  SlewPlanner patient({.coast_s = 60.0, .dwell_s = 1e-4});
  for (int i = 0; i < 300; ++i) {
    const auto slew = plan(patient, now_us + i * 1000, {narrow}, tracks).at(0);
    spread = std::max(spread, angle_between(enu_from_azimuth_elevation(slew.direction),
                                            enu_from_azimuth_elevation(first.direction)));
  }
  EXPECT_GT(spread, sd);
  EXPECT_LT(spread, 6.0 * sd + 0.05);
}

}  // namespace
}  // namespace ols::fusion
