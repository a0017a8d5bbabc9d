#include "calibration/target.h"

#include <gtest/gtest.h>

#include "tests/unit/calibration/scene.h"
#include "tests/unit/geometry/near.h"

namespace ols::calibration {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using ols::test::near;

constexpr std::int64_t kNoon_us = 1'780'000'000'000'000;

State two_stations() {
  State state;
  StationPrior prior{.model = test::hill()};
  state.stations.push_back(station_at(prior, StationVector::Zero()));
  prior.model.geometry.position.longitude_rad += 1e-4;
  state.stations.push_back(station_at(prior, StationVector::Zero()));
  return state;
}

Sighting now(std::size_t station = 0) {
  Sighting sighting;
  sighting.station = station;
  sighting.utime_us = kNoon_us;
  sighting.pixel = {640.0, 480.0};
  return sighting;
}

Vector3d above(double east, double north, double up) {
  return LocalFrame(test::hill().geometry.position).to_ecef({east, north, up});
}

// Flies east at 100 m/s over a point 3 km to the north.
Trajectory flight() {
  Trajectory trajectory;
  trajectory.sd_m = 10.0;
  for (int s = -10; s <= 10; s += 5) {
    trajectory.points.push_back({kNoon_us + s * 1'000'000, above(100.0 * s, 3000.0, 1000.0)});
  }
  return trajectory;
}

// (x, w) by each nuisance, against differences.
void expect_derivatives(const Target& target, const State& state, const VectorXd& at) {
  constexpr double kStep = 1e-4;
  const TargetView here = target.view(state, now(), at);
  for (Eigen::Index k = 0; k < at.size(); ++k) {
    const auto view = [&](double by) {
      VectorXd nuisance = at;
      nuisance[k] += by;
      const TargetView there = target.view(state, now(), nuisance);
      return Eigen::Vector4d(there.point.x.x(), there.point.x.y(), there.point.x.z(),
                             there.point.w);
    };
    const Eigen::Vector4d numeric = (view(kStep) - view(-kStep)) / (2.0 * kStep);
    EXPECT_TRUE(near(here.by_nuisance.col(k), numeric, 2e-3 * numeric.norm())) << k;
  }
}

TEST(Target, DerivativesByTheNuisanceAreThoseOfDifferences) {
  const State state = two_stations();
  expect_derivatives(*fixed_target({above(500.0, 800.0, 20.0), 0.1}), state, Vector3d(0.3, 0.1, 0));
  expect_derivatives(*scene_target(), state, Vector3d(1.0, 0.2, 1e-3));
  expect_derivatives(*unknown_target(), state, above(300.0, 900.0, 100.0));
  expect_derivatives(*aircraft_target(flight()), state, Eigen::Vector4d(3.0, -2.0, 5.0, 0.6));
  expect_derivatives(*drone_target(flight()), state, Vector3d(0.1, -0.1, 0.05));
}

TEST(Target, AnAircraftIsWhereItWasAnnouncedLater) {
  const auto target = aircraft_target(flight());
  const State state = two_stations();
  const Vector3d at_once = target->view(state, now(), Eigen::Vector4d::Zero()).point.x;
  const Vector3d late = target->view(state, now(), Eigen::Vector4d(0, 0, 0, 0.5)).point.x;
  EXPECT_TRUE(near(late - at_once, Vector3d(50.0, 0.0, 0.0), 0.1));
}

TEST(Target, TheAirLiftsALandmarkByItsDistanceOverTheEarthsDiameter) {
  StationPrior prior{.model = test::hill()};
  State state = two_stations();
  prior.refraction = 0.13;
  state.stations[0] = station_at(prior, StationVector::Zero());
  const TargetView view =
      fixed_target({above(0.0, 2000.0, 0.0), 0.1})->view(state, now(), Vector3d::Zero());
  EXPECT_NEAR(view.point.x.z() / 2000.0, 0.13 * 2000.0 / 2.0 / 6371e3, 1e-8);
  // From an aircraft 10 km up the ray comes through thin air: about half.
  const TargetView high =
      fixed_target({above(0.0, 30000.0, 10000.0), 0.1})->view(state, now(), Vector3d::Zero());
  const double lift = high.by_refraction.norm() / high.point.x.norm();
  EXPECT_NEAR(lift / (high.point.x.norm() / 6371e3), 0.344, 0.001);
}

// Its direction has the usual air in it already.
TEST(Target, AStarIsWhereItAppearsAndMovesWithTheAirAndTheEarth) {
  State state = two_stations();
  const Eigen::Matrix3d R = R_ecef_enu(test::hill().geometry.position).transpose();
  SkyDirection star;
  star.ecef = R.transpose() * Vector3d(0.0, 0.8, 0.6);
  star.by_air = R.transpose() * Vector3d(0.0, -6e-4, 8e-4);
  star.by_ut1 = R.transpose() * Vector3d(7e-5, 0.0, 0.0);
  const auto seen = [&] { return sky_target(star)->view(state, now(), VectorXd(0)).point.x; };
  EXPECT_TRUE(near(seen(), Vector3d(0.0, 0.8, 0.6), 1e-12));
  state.stations[0].air = 1.1;
  state.ut1_s = 0.2;
  EXPECT_TRUE(near(seen(), Vector3d(1.4e-5, 0.8 - 6e-5, 0.6 + 8e-5), 1e-12));
}

TEST(Target, AnUnknownPlaceBeginsWhereTheLinesOfSightMeet) {
  const State state = two_stations();
  const Vector3d place = above(400.0, 700.0, 90.0);
  std::vector<Sighting> sightings{now(0), now(1)};
  for (Sighting& one : sightings) {
    const StationModel& model = state.stations[one.station].model;
    const auto angles = aim_at(model.geometry, place, one.pixel);
    one.reading.pan.counts = angles->pan_rad / (2.0 * kPi) * 112000.0;
    one.reading.tilt.counts = angles->tilt_rad / (2.0 * kPi) * 112000.0;
  }
  // The origin of a line is GROUND, metres below the camera.
  EXPECT_LT((unknown_target()->initial(state, sightings) - place).norm(), 4.0);
}

TEST(Target, AnotherStationMovesWithItsPosition) {
  const State state = two_stations();
  const auto target = station_target(1);
  StationPrior prior{.model = state.stations[1].model};
  StationVector moved = StationVector::Zero();
  moved[kEast] = 2.0;
  State other = state;
  other.stations[1] = station_at(prior, moved);
  const TargetView here = target->view(state, now(), VectorXd(0));
  const Vector3d by = target->view(other, now(), VectorXd(0)).point.x - here.point.x;
  EXPECT_TRUE(near(2.0 * here.by_position.col(0), by, 1e-3));
  EXPECT_NEAR(by.x(), 2.0, 1e-3);
  EXPECT_EQ(target->on_station(), 1U);
}

}  // namespace
}  // namespace ols::calibration
