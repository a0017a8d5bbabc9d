// Constant pose errors as the stations state them: headings, tilts, positions.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "central/offline/offline_fusion.h"
#include "dev/estimators/bearing_world.h"
#include "geometry/angles.h"
#include "tests/unit/central/flight.h"

namespace ols::bench {

using namespace ols::fusion;

namespace {

using Eigen::Vector3d;

constexpr double kDurationS = 60.0;

// Twice around, so that each station looks into many directions.
Path circling() {
  Path path;
  for (int i = 0; i < kDurationS * kPathHz + 3; ++i) {
    const double turn = 4.0 * kPi * i / (kDurationS * kPathHz);
    const double rate = 4.0 * kPi / kDurationS;
    path.push_back({{120.0 * std::cos(turn), 120.0 * std::sin(turn), 60.0 + 20.0 * std::sin(turn)},
                    120.0 * rate * Vector3d(-std::sin(turn), std::cos(turn), 0.0)});
  }
  return path;
}

// Each of a station's bearings by another track id: its bias would be new every time.
void rename_each(std::vector<BearingMeasurement>& measurements) {
  std::int64_t name = 0;
  for (BearingMeasurement& measurement : measurements) measurement.track_id = ++name;
}

// Each station follows a point of the target, up to metres off its middle: constant across its
// line.
void follow_points(double sd_m, const Path& path, std::vector<BearingMeasurement>& measurements,
                   std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  std::map<std::string, std::pair<Eigen::Vector2d, double>> followed;  // offset, first range [m]
  for (BearingMeasurement& measurement : measurements) {
    LineOfSight& sight = measurement.sight;
    const double time_s = 1e-6 * static_cast<double>(measurement.utime_us - kStartUs);
    const double range_m = (site().to_ecef(at(path, time_s).p_enu) - sight.origin_ecef).norm();
    const double right_m = sd_m * normal(random), up_m = sd_m * normal(random);
    const auto& [offset_m, first_range_m] =
        followed.try_emplace(measurement.station, Eigen::Vector2d(right_m, up_m), range_m)
            .first->second;
    AzimuthElevation& direction = sight.direction;
    direction.azimuth_rad += offset_m.x() / (range_m * std::cos(direction.elevation_rad));
    direction.elevation_rad += offset_m.y() / range_m;
    sight.aim_sd_rad = sd_m / first_range_m;
    sight.covariance_systematic.diagonal().array() += sight.aim_sd_rad * sight.aim_sd_rad;
  }
}

struct Result {
  double nees = 0.0, error_m = 0.0;
};

using Change = std::function<void(std::vector<BearingMeasurement>&, std::mt19937_64&)>;

Result fly(const WorldConfig& world, const OfflineConfig& config, const Change& change = {}) {
  constexpr int kRuns = 12;
  constexpr double kSettledS = 10.0;
  const Path path = circling();
  double nees = 0.0, squared = 0.0;
  int fixes = 0;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    std::mt19937_64 random(seed);
    std::vector<BearingMeasurement> measurements = measure(world, {path}, kDurationS, random);
    if (change) change(measurements, random);
    for (const FusedTarget& target : fuse_offline(measurements, config)) {
      const double time_s = 1e-6 * static_cast<double>(target.utime_us - kStartUs);
      if (time_s < kSettledS) continue;
      const Vector3d e = target.estimate.position_ecef - site().to_ecef(at(path, time_s).p_enu);
      nees += e.dot(target.estimate.covariance_ecef.ldlt().solve(e)) / 3.0;
      squared += e.squaredNorm();
      ++fixes;
    }
  }
  return {nees / fixes, std::sqrt(squared / fixes)};
}

TrackFilter filter_on(const Path& path) {
  return TrackFilter({}, kStartUs,
                     {.p_ecef = site().to_ecef(path.front().p_enu),
                      .position_sd_m = 10.0,
                      .velocity_sd_m_s = 10.0});
}

WorldConfig world_of(double tilt_sd_rad, double heading_sd_rad, double place_sd_m) {
  WorldConfig world{.stations_enu = circle(4, 300.0), .aims_enu = {}, .rate_hz = 10.0};
  world.bias_sd_rad = tilt_sd_rad;
  world.heading_sd_rad = heading_sd_rad;
  world.place_sd_m = place_sd_m;
  return world;
}

// Only the bias that is observable within a minute is learnt.
TEST(PoseErrors, ARotationOfTheStationsIsFound) {
  const Result result = fly(world_of(5e-4, 1e-3, 0.0), {});
  EXPECT_GT(result.nees, 0.5);
  EXPECT_LT(result.nees, 1.3);
  // One instant alone: 1 mrad at 300 m by four stations.
  EXPECT_LT(result.error_m, 0.12);
}

TEST(PoseErrors, APlaceThatIsOffIsNotTakenForARotation) {
  const WorldConfig world = world_of(5e-4, 1e-3, 0.5);
  const Result apart = fly(world, {});
  EXPECT_GT(apart.nees, 0.4);
  EXPECT_LT(apart.nees, 1.6);
  OfflineConfig within;
  within.fusion.tracks.filter.place_share = std::numeric_limits<double>::infinity();
  EXPECT_GT(fly(world, within).nees, 3.0 * apart.nees) << "and this is why";
}

TEST(PoseErrors, WhoChangesItsMindWithEachFrameIsNotBelievedMore) {
  const auto renamed = [](auto& measurements, std::mt19937_64&) { rename_each(measurements); };
  EXPECT_LT(fly(world_of(5e-4, 1e-3, 0.0), {}, renamed).nees, 1.3);
  EXPECT_LT(fly(world_of(5e-4, 1e-3, 1.0), {}, renamed).nees, 1.6);
}

TEST(PoseErrors, APointOfTheTargetIsSeenUnderAnAngleThatGrowsAsItComesNearer) {
  const WorldConfig world = world_of(5e-5, 1e-4, 0.0);
  const auto points = [](auto& measurements, std::mt19937_64& random) {
    follow_points(0.3, circling(), measurements, random);
  };
  const double nees = fly(world, {}, points).nees;
  EXPECT_GT(nees, 0.5);
  // These points turn with the line of sight, by more than a right angle; those of the states do
  // not.
  EXPECT_LT(nees, 3.5);
  const auto taken_as_angles = [&](auto& measurements, std::mt19937_64& random) {
    points(measurements, random);
    for (BearingMeasurement& measurement : measurements) measurement.sight.aim_sd_rad = 0.0;
  };
  EXPECT_GT(fly(world, {}, taken_as_angles).nees, 3.0 * nees) << "and this is why";
}

// Far away a position error is small compared with a heading error; nearby it dominates.
TEST(PoseErrors, APlaceBeginsToMatterAsATargetComesNearer) {
  constexpr double kFlightS = 95.0;
  WorldConfig world = world_of(3e-4, 1e-3, 0.5);
  double nees = 0.0;
  int fixes = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    std::mt19937_64 random(seed);
    const Path path = cruising({{6000, 100, 400}, {-60, 0, -3}}, 0.1, kFlightS, random);
    for (const FusedTarget& target : fuse_offline(measure(world, {path}, kFlightS, random), {})) {
      const double time_s = 1e-6 * static_cast<double>(target.utime_us - kStartUs);
      if (time_s < kFlightS - 10.0) continue;
      const Vector3d e = target.estimate.position_ecef - site().to_ecef(at(path, time_s).p_enu);
      nees += e.dot(target.estimate.covariance_ecef.ldlt().solve(e)) / 3.0;
      ++fixes;
    }
  }
  EXPECT_GT(fixes, 100);
  EXPECT_LT(nees / fixes, 2.0);
}

// With a base of 30 m the difference of the headings is not observable: minutes of bearings must
// not estimate one. The paper's walk.
TEST(PoseErrors, WhatAShortBaseHidesIsNotFound) {
  constexpr double kWalkS = 120.0;
  for (const double noise_rad : {7e-6, 22e-6, 75e-6}) {
    WorldConfig world{.stations_enu = circle(2, 15.0), .aims_enu = {}, .rate_hz = 15.0};
    world.noise_rad = noise_rad;
    world.bias_sd_rad = 75e-6;
    world.heading_sd_rad = 5e-4;
    world.place_sd_m = 0.01;
    double squared = 0.0;
    constexpr int kRuns = 8;
    for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
      std::mt19937_64 random(seed);
      const Path path = cruising({{0, 50, 1}, {0.1, 0.9, 0}}, 0.02, kWalkS, random);
      const auto targets = fuse_offline(measure(world, {path}, kWalkS, random), {});
      ASSERT_FALSE(targets.empty());
      const double last_s = 1e-6 * static_cast<double>(targets.back().utime_us - kStartUs);
      EXPECT_GT(last_s, kWalkS - 0.2);
      const Estimate& last = targets.back().estimate;
      const Vector3d e = last.position_ecef - site().to_ecef(at(path, last_s).p_enu);
      squared += e.dot(last.covariance_ecef.ldlt().solve(e)) / 3.0;
    }
    EXPECT_LT(squared / kRuns, 2.1) << noise_rad;  // 24 degrees of freedom: 1 in 1000 is above
    EXPECT_GT(squared / kRuns, 0.2) << noise_rad;
  }
}

// Rounding must not make the covariance indefinite in a long flight: eight stations for minutes.
TEST(PoseErrors, ALongFlightKeepsItsTrack) {
  constexpr double kFlightS = 300.0;
  WorldConfig world{.stations_enu = circle(8, 300.0), .aims_enu = {}};
  world.bias_sd_rad = 3e-4;
  world.place_sd_m = 1.0;
  std::mt19937_64 random(3);
  const Path path = cruising({{-100, 20, 120}, {0.7, 0.1, 0.0}}, 0.01, kFlightS, random);
  Fusion fusion(FusionConfig{});
  for (const BearingMeasurement& measurement : measure(world, {path}, kFlightS, random))
    fusion.add(measurement);
  EXPECT_EQ(fusion.tracks().counts().deleted, 0);
  ASSERT_EQ(fusion.tracks().tracks().size(), 1U);
  const FilterMatrix P = fusion.tracks().tracks().front().filter.mixed().covariance;
  const Eigen::VectorXd sd = P.diagonal().cwiseMax(1e-30).cwiseSqrt();
  const Eigen::MatrixXd correlation = P.cwiseQuotient(sd * sd.transpose());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(correlation, Eigen::EigenvaluesOnly);
  EXPECT_GT(axes.eigenvalues().minCoeff(), -1e-9);
}

// A station with a new calibration starts again, and is not rejected.
TEST(PoseErrors, ANewDesignationMayBeOffAsStated) {
  constexpr double kFlightS = 30.0, kTurnedS = 10.0, kOffRad = 5e-3;
  WorldConfig world = world_of(1e-5, kOffRad, 0.0);
  std::mt19937_64 random(4);
  const Path path = cruising({{-100, 20, 120}, {5, 1, 0}}, 0.1, kFlightS, random);
  TrackFilter filter = filter_on(path);
  BiasModel errors;
  for (BearingMeasurement& measurement : measure(world, {path}, kFlightS, random)) {
    measurement.track_id = 1;
    const double time_s = 1e-6 * static_cast<double>(measurement.utime_us - kStartUs);
    if (measurement.station == "s0" && time_s > kTurnedS) {
      measurement.track_id = 2;
      measurement.sight.direction.azimuth_rad += kOffRad;
      ASSERT_LT(filter.innovation(measurement, errors).nis, 25.0) << time_s;
    }
    test::feed(filter, measurement, errors);
  }
}

// ... but by no more than that, however often it is designated.
TEST(PoseErrors, ItIsNeverLessCertainThanStated) {
  constexpr double kFlightS = 10.0;
  const WorldConfig world = world_of(5e-4, 1e-3, 0.0);
  std::mt19937_64 random(4);
  const Path path = cruising({{-100, 20, 120}, {5, 1, 0}}, 0.1, kFlightS, random);
  TrackFilter filter = filter_on(path);
  BiasModel errors;
  std::vector<BearingMeasurement> seen = measure(world, {path}, kFlightS, random);
  rename_each(seen);
  for (const BearingMeasurement& measurement : seen) test::feed(filter, measurement, errors);
  ASSERT_EQ(filter.stations().size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    const StationBias bias = filter.bias(i);
    EXPECT_LT(bias.covariance_rad2.trace(), 1.01 * bias.prior_rad2.trace());
  }
}

// With another designation a station follows another point of the target. The others do not: they
// hold the target's place.
TEST(PoseErrors, ANewDesignationMayBeOfAnotherPoint) {
  constexpr double kFlightS = 22.0, kAgainS = 20.0, kBeside_m = 3.0;
  const Path path = circling();
  std::mt19937_64 random(4);
  std::vector<BearingMeasurement> seen =
      measure(world_of(1e-6, 1e-6, 0.0), {path}, kFlightS, random);
  follow_points(1.0, path, seen, random);
  TrackFilter filter = filter_on(path);
  BiasModel errors;
  std::optional<Vector3d> before;
  double moved_m = 0.0;
  for (BearingMeasurement& measurement : seen) {
    const double time_s = 1e-6 * static_cast<double>(measurement.utime_us - kStartUs);
    const Vector3d truth = site().to_ecef(at(path, time_s).p_enu);
    const bool is_again = measurement.station == "s0" && time_s > kAgainS;
    measurement.track_id = is_again ? 2 : 1;
    AzimuthElevation& direction = measurement.sight.direction;
    const double level_m =
        (truth - measurement.sight.origin_ecef).norm() * std::cos(direction.elevation_rad);
    if (is_again) direction.azimuth_rad += kBeside_m / level_m;
    if (is_again) ASSERT_LT(filter.innovation(measurement, errors).nis, 25.0) << time_s;
    test::feed(filter, measurement, errors);
    const Vector3d error = filter.position() - truth;
    if (time_s <= kAgainS) before = error;
    if (time_s > kAgainS) moved_m = std::max(moved_m, (error - *before).norm());
  }
  EXPECT_LT(moved_m, 0.3);
}

}  // namespace
}  // namespace ols::bench
