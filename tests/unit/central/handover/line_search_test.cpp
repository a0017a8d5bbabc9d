#include "central/handover/line_search.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "geometry/angles.h"
#include "tests/unit/central/flight.h"

namespace ols::fusion {
namespace {

using Eigen::Vector3d;
using test::site;

constexpr double kStep_s = 0.02;

// From a place in the south towards the north, rising.
CueRay ray() {
  CueRay ray{"overview", 1, test::kStart, site().to_ecef({0, -340, 6})};
  ray.direction_ecef = (site().R_ecef_enu() * Vector3d(0.1, 1.0, 0.2)).normalized();
  ray.sd_rad = 1e-3;
  return ray;
}

StationTraits station(const Vector3d& p_enu, double view_rad = 0.07) {
  StationTraits traits;
  traits.camera_ecef = site().to_ecef(p_enu);
  traits.field_of_view_rad = view_rad;
  return traits;
}

Vector3d ecef(const StationTraits& station, const AzimuthElevation& direction) {
  return R_ecef_enu(station.camera_ecef) * enu_from_azimuth_elevation(direction);
}

TEST(LineSearch, TheSearchersBeginWithEqualPartsOfTheProbability) {
  const LinePrior prior{400.0, 100.0};
  double before_m = 0.0;
  for (const int rank : {0, 1, 2, 3}) {
    const SweepStart start = sweep_start(prior, {rank, 4}, {});
    EXPECT_EQ(start.outwards, rank >= 2);
    EXPECT_GE(start.range_m, before_m);
    before_m = start.range_m;
  }
  const auto range_m = [&](int rank, int of) { return sweep_start(prior, {rank, of}, {}).range_m; };
  EXPECT_DOUBLE_EQ(range_m(1, 4), 400.0);
  EXPECT_DOUBLE_EQ(range_m(2, 4), 400.0);
  // Of a logistic distribution with this deviation, a quarter lies beyond 0.606 of it.
  EXPECT_NEAR(range_m(0, 4), 400.0 - 60.6, 0.1);
  EXPECT_NEAR(range_m(3, 4), 400.0 + 60.6, 0.1);
  EXPECT_NEAR(range_m(0, 1), 400.0 - 60.6, 0.1);
  EXPECT_TRUE(sweep_start(prior, {0, 1}, {}).outwards);
  EXPECT_DOUBLE_EQ(range_m(0, 2), 400.0);
  EXPECT_DOUBLE_EQ(sweep_start({-1e6, 100.0}, {0, 4}, {}).range_m, LineSearchConfig{}.near_m);
  EXPECT_DOUBLE_EQ(sweep_start({1e9, 100.0}, {0, 4}, {}).range_m, LineSearchConfig{}.far_m);
}

TEST(LineSearch, ALargeObjectIsExpectedNear) {
  CueRay seen = ray();
  EXPECT_FALSE(range_by_size(seen)) << "its size is unknown";
  seen.size_rad = 0.002;
  seen.size_sd_rad = 0.002;
  EXPECT_FALSE(range_by_size(seen)) << "a point";
  seen.size_sd_rad = 0.0002;
  const auto near = range_by_size(seen);
  ASSERT_TRUE(near);
  EXPECT_NEAR(near->range_m, 300.0, 1e-9);  // of 0.6 m
  EXPECT_NEAR(near->sd_m, 300.0 * std::hypot(0.5, 0.1), 1e-9);
}

TEST(LineSearch, TwoExpectationsOfTheRangeAreOne) {
  const LinePrior both = combined({100.0, 50.0}, {400.0, 200.0});
  EXPECT_NEAR(both.range_m, 200.0, 1e-9);
  EXPECT_NEAR(both.sd_m, 200.0 * 0.5 / std::sqrt(2.0), 1e-9);
  const LinePrior first = combined({100.0, 50.0}, {40.0, 50.0});
  EXPECT_EQ(first.range_m, 100.0);
  EXPECT_EQ(first.sd_m, 50.0);
}

TEST(LineSearch, ATurnTakesAsLongAsItsAccelerationAndItsSpeedAllow) {
  LineSearchConfig config{.acceleration_rad_s2 = 2.0, .speed_rad_s = 1.0, .settle_s = 0.5};
  EXPECT_DOUBLE_EQ(turning_s(0.0, config), 0.5);
  EXPECT_DOUBLE_EQ(turning_s(0.5, config), 1.5);  // half a second up, half a second down
  EXPECT_DOUBLE_EQ(turning_s(2.5, config), 3.5);  // two seconds at full speed more
}

TEST(LineSearch, ASweepGoesToOneEndAndThenToAndFro) {
  const auto at = [](double swept, bool up) { return to_and_fro(2.0, swept, 5.0, up).angle_rad; };
  EXPECT_DOUBLE_EQ(at(0.0, true), 2.0);
  EXPECT_DOUBLE_EQ(at(3.0, true), 5.0);
  EXPECT_DOUBLE_EQ(at(4.0, true), 4.0);
  EXPECT_DOUBLE_EQ(at(8.0, true), 0.0);
  EXPECT_DOUBLE_EQ(at(9.0, true), 1.0);
  EXPECT_DOUBLE_EQ(at(1.0, false), 1.0);
  EXPECT_DOUBLE_EQ(at(3.0, false), 1.0);
  EXPECT_TRUE(to_and_fro(2.0, 2.9, 5.0, true).up);
  EXPECT_FALSE(to_and_fro(2.0, 3.1, 5.0, true).up);
  EXPECT_EQ(to_and_fro(2.0, 1.0, 0.0, true).angle_rad, 0.0) << "the station stands on the line";
}

TEST(LineSearch, ARayIsCarriedOnWithItsTarget) {
  CueRay moving = ray();
  moving.rate_ecef = 0.04 * moving.direction_ecef.cross(Vector3d::UnitX()).normalized();
  const CueRay later = moving.at(moving.utime_us + 500'000);
  EXPECT_NEAR(angle_between(moving.direction_ecef, later.direction_ecef), 0.02, 1e-5);
  EXPECT_NEAR(later.direction_ecef.norm(), 1.0, 1e-12);
}

// It stands where it begins until the unit has come there, and then crosses a view in its time.
TEST(LineSearch, ASweepWaitsForItsUnitAndThenGoesOnEvenly) {
  const StationTraits alfa = station({-250, -250, 0});
  StationTraits there = alfa;
  const LineSearchConfig config;
  const SweepStart start{400.0, true};
  const LineSweep unknown(ray(), alfa, start, config);
  const AzimuthElevation begin = unknown.look(ray(), alfa, 0.0).direction;
  there.axis = begin;
  const LineSweep arrived(ray(), there, start, config);
  const auto off_rad = [&](const LineSweep& sweep, double searched_s) {
    return angle_between(enu_from_azimuth_elevation(begin),
                         enu_from_azimuth_elevation(sweep.look(ray(), alfa, searched_s).direction));
  };
  EXPECT_LT(off_rad(arrived, config.settle_s), 1e-9);
  EXPECT_NEAR(off_rad(arrived, config.settle_s + config.view_s), 0.07, 1e-6);
  EXPECT_LT(off_rad(unknown, 1.0), 1e-9) << "nobody knows where it looks";
  EXPECT_GT(off_rad(unknown, 3.0), 0.05);
}

TEST(LineSearch, EveryLookIsOnTheLineAndItsRateLeadsToTheNext) {
  const StationTraits alfa = station({-250, -250, 0});
  CueRay moving = ray();
  moving.rate_ecef = site().R_ecef_enu() * Vector3d(0.02, 0.0, 0.02);
  const LineSweep sweep(moving, alfa, {400.0, false}, {});
  double nearest = 10.0, farthest = 0.0;
  for (double t_s = 0.0; t_s < 40.0; t_s += kStep_s) {
    const LineLook look = sweep.look(moving, alfa, t_s);
    const Vector3d direction = ecef(alfa, look.direction);
    const Vector3d normal =
        (alfa.camera_ecef - moving.origin_ecef).cross(moving.direction_ecef).normalized();
    ASSERT_NEAR(direction.dot(normal), 0.0, 1e-9) << t_s;
    const Vector3d along = R_ecef_enu(alfa.camera_ecef) * tangent_basis(look.direction) * look.line;
    ASSERT_NEAR(along.dot(normal), 0.0, 1e-6) << t_s;
    ASSERT_NEAR(look.line.norm(), 1.0, 1e-9);
    const double angle = angle_between(direction, moving.direction_ecef);
    nearest = std::min(nearest, angle);
    farthest = std::max(farthest, angle);
  }
  EXPECT_LT(nearest, 0.1) << "far away it is the line's own direction";
  EXPECT_GT(farthest, 1.6) << "near its origin";
}

TEST(LineSearch, TheRateIsThatOfSweepAndRayTogether) {
  StationTraits alfa = station({-250, -250, 0});
  CueRay moving = ray();
  moving.rate_ecef = site().R_ecef_enu() * Vector3d(0.02, 0.0, 0.02);
  const LineSweep sweep(moving, alfa, {400.0, true}, {});
  constexpr double kAt_s = 3.0, kThen_s = 0.05;
  const LineLook now = sweep.look(moving, alfa, kAt_s);
  const CueRay then = moving.at(moving.utime_us + 50'000);
  const LineLook next = sweep.look(then, alfa, kAt_s + kThen_s);
  const Vector3d predicted = enu_from_azimuth_elevation(now.direction) +
                             kThen_s * tangent_basis(now.direction) * now.rate_rad_s;
  EXPECT_LT(angle_between(predicted, enu_from_azimuth_elevation(next.direction)), 2e-4);
  EXPECT_NEAR(now.rate_rad_s.norm(), 0.07 / LineSearchConfig{}.view_s, 0.06);
}

// A kilometre of a line that is known to a thousandth is a metre beside it.
TEST(LineSearch, TheDeviationBesideTheLineGrowsWithTheRayAndTheStationsPlace) {
  StationTraits beside = station({-250, 60, 0});
  const LineSweep sweep(ray(), beside, {400.0, true}, {});
  const double sd_rad = sweep.look(ray(), beside, 0.0).sd_rad;
  EXPECT_NEAR(sd_rad, 1e-3 * 400.0 / 301.0, 1e-5);
  beside.camera_sd_enu_m = {3.0, 0.0, 0.0};
  EXPECT_NEAR(sweep.look(ray(), beside, 0.0).sd_rad, std::hypot(sd_rad, 3.0 / 301.0), 1e-4);
}

// It cannot look beside the line; it still gets a direction.
TEST(LineSearch, AStationOnTheLineLooksAlongIt) {
  const StationTraits same = station({0, -340, 6});
  const LineLook look = LineSweep(ray(), same, {400.0, true}, {}).look(ray(), same, 10.0);
  EXPECT_LT(angle_between(ecef(same, look.direction), ray().direction_ecef), 1e-6);
  EXPECT_TRUE(look.rate_rad_s.allFinite());
  EXPECT_NEAR(look.line.norm(), 1.0, 1e-9);
}

}  // namespace
}  // namespace ols::fusion
