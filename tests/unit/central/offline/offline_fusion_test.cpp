#include "central/offline/offline_fusion.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "geometry/angles.h"
#include "tests/unit/central/scene.h"

namespace ols::fusion {
namespace {

using Eigen::Vector3d;
using test::measurement_of;
using test::ray_to;
using test::site;
using test::square;

constexpr std::int64_t kStart = 1'600'000'000'000'000;

Vector3d path(double t_s) {
  return {100.0 * std::sin(0.2 * t_s), 80.0 * std::cos(0.2 * t_s), 100.0 + t_s};
}

// Four stations with their own rates and phases; "c" sees the target only in the first half.
// `stated` is their stated systematic error in units of their noise; the true one is zero.
std::vector<BearingMeasurement> recording(double seconds, double sigma_rad, unsigned seed,
                                          double stated = 0.0) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<BearingMeasurement> measurements;
  const double rates_hz[] = {25.0, 30.0, 50.0, 27.3};
  for (std::size_t k = 0; k < 4; ++k) {
    for (double t_s = 0.007 * static_cast<double>(k); t_s < seconds; t_s += 1.0 / rates_hz[k]) {
      if (k == 2 && t_s > seconds / 2.0) break;
      Ray ray =
          ray_to(std::string(1, static_cast<char>('a' + k)), square()[k], path(t_s), sigma_rad);
      ray = test::turned(ray, sigma_rad * normal(random), sigma_rad * normal(random));
      ray.sight.covariance_systematic =
          Eigen::Matrix2d::Identity() * std::pow(stated * sigma_rad, 2);
      measurements.push_back(measurement_of(ray, kStart + std::llround(t_s * 1e6)));
    }
  }
  return measurements;
}

Vector3d error(const FusedTarget& target) {
  const double t_s = static_cast<double>(target.utime_us - kStart) * 1e-6;
  return target.estimate.position_ecef - site().to_ecef(path(t_s));
}

// Mean squared error over the covariance; 1 is consistent, less is cautious.
double normalised_square(const std::vector<FusedTarget>& targets) {
  double sum = 0.0;
  for (const FusedTarget& target : targets) {
    sum += error(target).squaredNorm() / target.estimate.covariance_ecef.trace();
  }
  return sum / static_cast<double>(targets.size());
}

TEST(OfflineFusion, InterpolatesAndIsHonest) {
  OfflineConfig config;
  config.estimator = "least-squares";
  config.rate_hz = 10.0;
  const auto targets = fuse_offline(recording(40.0, 2e-4, 3, 0.01), config);
  ASSERT_GT(targets.size(), 395U);
  for (const FusedTarget& target : targets) EXPECT_LT(error(target).norm(), 0.4);
  EXPECT_GT(normalised_square(targets), 0.6);
  EXPECT_LT(normalised_square(targets), 1.4);
  EXPECT_EQ(targets.front().utime_us, kStart);
  EXPECT_EQ(targets[1].utime_us, kStart + 100'000);
  EXPECT_EQ(targets[10].stations.size(), 4U);
  EXPECT_EQ(targets.back().stations.size(), 3U);
}

// Without a stated systematic error, one as large as the noise is assumed until the bearings show
// that there is none: the covariance is never too small, and not much too large.
TEST(OfflineFusion, IsCautiousWhereNothingIsStated) {
  for (const char* name : {"least-squares", "filter"}) {
    OfflineConfig config;
    config.estimator = name;
    config.rate_hz = 10.0;
    const auto targets = fuse_offline(recording(40.0, 2e-4, 3), config);
    ASSERT_GT(targets.size(), 390U) << name;
    for (const FusedTarget& target : targets) EXPECT_LT(error(target).norm(), 0.4) << name;
    EXPECT_GT(normalised_square(targets), 0.2) << name;
    EXPECT_LT(normalised_square(targets), 1.0) << name;
  }
}

// Undeclared errors that the residuals show may be partly common-mode, which residuals do not show:
// the covariance is inflated for that, and nothing else changes.
TEST(OfflineFusion, LeavesRoomForWhatAllStationsHaveInCommon) {
  auto measurements = recording(20.0, 1e-4, 6);
  for (BearingMeasurement& s : measurements) {
    s.sight.direction.elevation_rad += (s.station == "a" || s.station == "c") ? 1e-3 : -1e-3;
  }
  OfflineConfig none, some;
  none.fusion.tracks.filter.common_mode = 0.0;
  const Estimate before = fuse_offline(measurements, none).back().estimate;
  const Estimate after = fuse_offline(measurements, some).back().estimate;
  EXPECT_EQ(before.position_ecef, after.position_ecef);
  EXPECT_GT(after.covariance_ecef.trace(), 1.1 * before.covariance_ecef.trace());
  EXPECT_LT(after.covariance_ecef.trace(), 2.01 * before.covariance_ecef.trace());
}

// All bearings of a recording belong to its one object: a track that most stations contradict is
// replaced.
TEST(OfflineFusion, BeginsAnewWhereMostStationsContradict) {
  auto measurements = recording(12.0, 1e-4, 5, 1.0);
  const std::int64_t jump_us = kStart + 5'000'000;
  for (BearingMeasurement& s : measurements) {
    if (s.utime_us < jump_us || s.station == "a") continue;
    const double t_s = static_cast<double>(s.utime_us - kStart) * 1e-6;
    s.sight = ray_to(s.station, square()[static_cast<std::size_t>(s.station[0] - 'a')],
                     {0.0, 0.0, 30.0 + t_s}, 1e-4)
                  .sight;
  }
  const auto targets = fuse_offline(measurements, {});
  ASSERT_FALSE(targets.empty());
  const Vector3d there = site().to_ecef({0.0, 0.0, 42.0});
  EXPECT_LT((targets.back().estimate.position_ecef - there).norm(), 2.0);
}

TEST(OfflineFusion, DoesNotDependOnTheOrderOfRows) {
  auto measurements = recording(3.0, 1e-4, 4);
  const auto first = fuse_offline(measurements, {});
  std::mt19937_64 random(1);
  std::ranges::shuffle(measurements, random);
  const auto second = fuse_offline(measurements, {});
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].utime_us, second[i].utime_us);
    EXPECT_EQ(first[i].estimate.position_ecef, second[i].estimate.position_ecef);
  }
}

TEST(OfflineFusion, EveryEstimatorFollows) {
  const auto measurements = recording(5.0, 1e-5, 5);
  for (const char* name : kEstimators) {
    OfflineConfig config;
    config.estimator = name;
    config.fusion.estimators.paper.moving_average = 1;
    config.rate_hz = 20.0;
    const auto targets = fuse_offline(measurements, config);
    ASSERT_GT(targets.size(), 95U) << name;
    for (const FusedTarget& target : targets) {
      EXPECT_EQ(target.estimator, name);
      EXPECT_LT(error(target).norm(), 0.1) << name;
    }
  }
  OfflineConfig guess;
  guess.estimator = "guess";
  EXPECT_THROW(fuse_offline(measurements, guess), std::invalid_argument);
}

TEST(OfflineFusion, MovingAverageTrails) {
  OfflineConfig config;
  config.rate_hz = 10.0;
  config.estimator = "paper";
  config.fusion.estimators.paper.moving_average = 10;
  const auto targets = fuse_offline(recording(5.0, 1e-5, 6), config);
  // 0.45 s behind at about 20 m/s.
  EXPECT_NEAR(error(targets[30]).norm(), 0.45 * 18.0, 2.5);
}

TEST(OfflineFusion, SmoothingIsBetterThanTheFilterAndAsHonest) {
  const auto measurements = recording(40.0, 2e-4, 8);
  double rms[2] = {0.0, 0.0};
  for (const bool smooth : {false, true}) {
    OfflineConfig config;
    config.rate_hz = 10.0;
    config.smooth = smooth;
    const auto targets = fuse_offline(measurements, config);
    ASSERT_GT(targets.size(), 390U);
    for (const FusedTarget& target : targets) {
      rms[smooth ? 1 : 0] += error(target).squaredNorm() / static_cast<double>(targets.size());
    }
    EXPECT_LT(normalised_square(targets), 1.5);
  }
  EXPECT_LT(rms[1], 0.8 * rms[0]);
}

// The white part of the covariance is positive semidefinite.
TEST(OfflineFusion, SmoothingTellsAWhitePartThatIsOne) {
  OfflineConfig config;
  config.rate_hz = 10.0;
  config.smooth = true;
  const auto targets = fuse_offline(recording(20.0, 2e-4, 8, 3.0), config);
  ASSERT_GT(targets.size(), 190U);
  for (const FusedTarget& target : targets) {
    const Eigen::Matrix3d white = target.estimate.covariance_white_ecef;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(white, Eigen::EigenvaluesOnly);
    EXPECT_GT(eigen.eigenvalues()(0), 0.0);
    EXPECT_LT(white.trace(), target.estimate.covariance_ecef.trace());
  }
}

// Two on a diagonal of the square are left: their rays are more nearly parallel.
TEST(OfflineFusion, TellsTheGeometryOfThoseThatStillSeeTheTarget) {
  auto measurements = recording(12.0, 1e-4, 8, 1.0);
  std::erase_if(measurements, [](const BearingMeasurement& s) {
    return s.utime_us > kStart + 6'000'000 && s.station != "b" && s.station != "d";
  });
  OfflineConfig config;
  config.rate_hz = 10.0;
  const auto targets = fuse_offline(measurements, config);
  ASSERT_FALSE(targets.empty());
  const FusedTarget& last = targets.back();
  ASSERT_GT(last.utime_us, kStart + 11'000'000);
  const auto direction = [&](std::size_t station) -> Vector3d {
    return (last.estimate.position_ecef - site().to_ecef(square()[station])).normalized();
  };
  const double angle = std::acos(direction(1).dot(direction(3)));
  EXPECT_NEAR(last.estimate.crossing_angle_rad, std::min(angle, kPi - angle), 1e-3);
}

// The noise is four times the stated one, which the filter's run learns: the velocity's covariance
// contains it.
TEST(OfflineFusion, LeastSquaresVelocityCountsTheNoiseThatIsLearnt) {
  auto measurements = recording(40.0, 8e-4, 9, 0.01);
  for (BearingMeasurement& s : measurements) s.sight.covariance_white /= 16.0;
  OfflineConfig config;
  config.estimator = "least-squares";
  config.rate_hz = 10.0;
  double sum = 0.0;
  const auto targets = fuse_offline(measurements, config);
  ASSERT_GT(targets.size(), 300U);
  for (const FusedTarget& target : targets) {
    const double t_s = static_cast<double>(target.utime_us - kStart) * 1e-6;
    const Vector3d v = (path(t_s + 0.01) - path(t_s - 0.01)) / 0.02;
    const Vector3d off = target.estimate.velocity_ecef - site().R_ecef_enu() * v;
    sum += off.squaredNorm() / target.estimate.velocity_covariance_ecef.trace();
  }
  EXPECT_LT(sum / static_cast<double>(targets.size()), 2.0);
}

// The filter at an instant does not depend on bearings later than half an alignment window.
TEST(OfflineFusion, TheFilterLooksNoFurtherAheadThanTheOthers) {
  auto measurements = recording(6.0, 2e-4, 9);
  const auto whole = fuse_offline(measurements, {});
  std::erase_if(measurements,
                [](const BearingMeasurement& s) { return s.utime_us > kStart + 3'000'000; });
  const auto part = fuse_offline(measurements, {});
  ASSERT_GT(part.size(), 100U);
  int later = 0;
  for (std::size_t i = 0; i < part.size(); ++i) {
    const bool is_same = part[i].estimate.position_ecef == whole[i].estimate.position_ecef;
    if (part[i].utime_us <= kStart + 2'850'000) {
      EXPECT_TRUE(is_same) << part[i].utime_us;
    } else {
      later += is_same ? 0 : 1;
    }
  }
  EXPECT_GT(later, 0);
}

TEST(OfflineFusion, OnlyTheFilterCanBeSmoothed) {
  OfflineConfig config;
  config.estimator = "paper";
  config.smooth = true;
  EXPECT_THROW(fuse_offline(recording(1.0, 1e-4, 7), config), std::invalid_argument);
}

TEST(OfflineFusion, RefusesARateWithoutAnEnd) {
  const auto measurements = recording(2.0, 1e-4, 7);
  for (const double rate_hz :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e7}) {
    OfflineConfig config;
    config.rate_hz = rate_hz;
    EXPECT_THROW(fuse_offline(measurements, config), std::invalid_argument) << rate_hz;
  }
}

TEST(OfflineFusion, CountsWhatItDoesNotUse) {
  auto measurements = recording(2.0, 1e-4, 7);
  OfflineReport report;
  fuse_offline(measurements, {}, &report);
  EXPECT_EQ(report.unused.low_belief, 0U);
  EXPECT_EQ(report.unused.duplicate, 0U);
  measurements.push_back(measurements[3]);
  measurements.push_back(measurements[3]);
  measurements[7].belief = 0.2;
  fuse_offline(measurements, {}, &report);
  EXPECT_EQ(report.unused.low_belief, 1U);
  EXPECT_EQ(report.unused.duplicate, 2U);
}

TEST(OfflineFusion, AClockIsGuessedByWhatItDoesToTheBearings) {
  auto measurements = recording(10.0, 1e-4, 7);
  guess_clocks(measurements);
  for (const BearingMeasurement& s : measurements) {
    EXPECT_GT(s.clock_sd_s, 5e-5 / 0.3);
    EXPECT_LT(s.clock_sd_s, 5e-5 / 0.02);
  }
  auto rough = recording(10.0, 1.6e-2, 7);
  guess_clocks(rough);
  for (const BearingMeasurement& s : rough) EXPECT_EQ(s.clock_sd_s, 0.02);
}

TEST(OfflineFusion, NothingGivesNothing) {
  EXPECT_TRUE(fuse_offline({}, {}).empty());
  auto alone = recording(2.0, 1e-4, 7);
  std::erase_if(alone,
                [](const BearingMeasurement& measurement) { return measurement.station != "a"; });
  EXPECT_TRUE(fuse_offline(alone, {}).empty());
}

// Two cameras 15 m apart state slow errors as noise. The bearings themselves are smooth, and show a
// motion that noise of the stated size would hide.
TEST(OfflineFusion, TwoStationsFollowAManoeuvreThatTheStatedNoiseWouldHide) {
  constexpr double kStated = 4e-3, kTrue = 2e-5, kSwingM = 12.0;
  const auto range_m = [](double t_s) { return 150.0 + kSwingM * std::sin(0.5 * t_s); };
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  std::vector<BearingMeasurement> measurements;
  for (int i = 0; i < 15 * 60; ++i) {
    const double t_s = i / 15.0;
    for (const double east_m : {-7.5, 7.5}) {
      Ray ray = ray_to(east_m < 0.0 ? "a" : "b", {east_m, 0.0, 0.0},
                       {0.5 * t_s, range_m(t_s), 40.0}, kStated);
      ray = test::turned(ray, kTrue * normal(random), kTrue * normal(random));
      measurements.push_back(measurement_of(ray, kStart + std::llround(t_s * 1e6)));
    }
  }
  double squared = 0.0;
  int count = 0;
  for (const FusedTarget& target : fuse_offline(measurements, OfflineConfig{})) {
    const double t_s = static_cast<double>(target.utime_us - kStart) * 1e-6;
    if (t_s < 20.0) continue;
    const double north_m = site().to_enu(target.estimate.position_ecef).y();
    squared += std::pow(north_m - range_m(t_s), 2);
    ++count;
  }
  ASSERT_GT(count, 500);
  EXPECT_LT(std::sqrt(squared / count), 0.3);
}

}  // namespace
}  // namespace ols::fusion
