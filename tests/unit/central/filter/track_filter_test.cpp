#include "central/filter/track_filter.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "geometry/wgs84.h"
#include "tests/unit/central/flight.h"

namespace ols::fusion {
namespace {

using Eigen::Vector3d;
using test::feed;
using test::flight;
using test::kStart;
using test::measurement_of;
using test::path;
using test::ray_to;
using test::site;
using test::square;
using test::turned;

TrackFilter filter_at(const Vector3d& p_enu, double sd_m = 100.0) {
  return TrackFilter(
      {}, kStart,
      {.p_ecef = site().to_ecef(p_enu), .position_sd_m = sd_m, .velocity_sd_m_s = 50.0});
}

Vector3d error(const TrackFilter& filter, std::int64_t utime_us) {
  const double t_s = static_cast<double>(utime_us - kStart) * 1e-6;
  return filter.at(utime_us).mean.head<3>() - site().to_ecef(path(t_s));
}

TEST(TrackFilter, FindsPositionAndVelocityFromStaggeredBearings) {
  BiasModel errors;
  TrackFilter filter = filter_at(path(0.0) + Vector3d(20, -10, 5));
  for (const BearingMeasurement& s : flight(3.0, 1e-4, 1e-4)) {
    EXPECT_EQ(feed(filter, s, errors), BearingUse::kUsed);
  }
  EXPECT_LT(error(filter, filter.utime_us()).norm(), 0.15);
  const Vector3d velocity = site().R_ecef_enu().transpose() * filter.velocity();
  EXPECT_LT((velocity - Vector3d(20, -5, 2)).norm(), 0.5);
  EXPECT_LT(error(filter, filter.utime_us() + 200'000).norm(), 0.3);
}

TEST(TrackFilter, ABearingWithoutANormalisedInnovationIsRejectedAndChangesNothing) {
  BiasModel errors;
  TrackFilter filter = filter_at(path(0.0));
  const std::vector<BearingMeasurement> bearings = flight(1.0, 1e-4, 1e-4);
  for (const BearingMeasurement& s : bearings) feed(filter, s, errors);
  BearingMeasurement broken = bearings.back();
  broken.sight.covariance_white(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(feed(filter, broken, errors), BearingUse::kRejected);
  EXPECT_TRUE(filter.at(filter.utime_us()).mean.allFinite());
}

// For a target that never turns, one model is enough.
TEST(TrackFilter, OneModelAloneFollowsWhatMovesLikeThat) {
  BiasModel errors;
  FilterConfig config;
  config.motion.models = {Motion::kConstantVelocity};
  TrackFilter filter(config, kStart,
                     {.p_ecef = site().to_ecef(path(0.0) + Vector3d(20, -10, 5)),
                      .position_sd_m = 100.0,
                      .velocity_sd_m_s = 50.0});
  for (const BearingMeasurement& s : flight(3.0, 1e-4, 1e-4)) {
    EXPECT_EQ(feed(filter, s, errors), BearingUse::kUsed);
  }
  EXPECT_EQ(filter.probabilities(), std::vector<double>{1.0});
  EXPECT_LT(error(filter, filter.utime_us()).norm(), 0.1);
  EXPECT_LT(error(filter, filter.utime_us() + 200'000).norm(), 0.2);
}

TEST(TrackFilter, RefusesToMixNoModel) {
  FilterConfig config;
  config.motion.models.clear();
  EXPECT_THROW(TrackFilter(config, kStart, {}), std::invalid_argument);
}

// Late bearings, out of order, each count at their own instant.
TEST(TrackFilter, LateBearingsCountAtTheirOwnInstant) {
  auto measurements = flight(3.0, 1e-4, 1e-4);
  BiasModel errors;
  TrackFilter in_order = filter_at(path(0.0)), late = filter_at(path(0.0));
  for (const BearingMeasurement& s : measurements) feed(in_order, s, errors);
  for (std::size_t i = 0; i + 8 < measurements.size(); i += 8) {
    std::swap(measurements[i], measurements[i + 7]);
  }
  BiasModel others;
  for (const BearingMeasurement& s : measurements)
    EXPECT_EQ(feed(late, s, others), BearingUse::kUsed);
  const std::int64_t end_us = in_order.utime_us();
  EXPECT_LT((in_order.at(end_us).mean - late.at(end_us).mean).head<3>().norm(), 0.1);
  BearingMeasurement ancient = measurements.front();
  ancient.utime_us -= 5'000'000;
  EXPECT_EQ(feed(late, ancient, others), BearingUse::kTooLate);
}

TEST(TrackFilter, SetsAWildRayAsideAndNamesWhatIsBehind) {
  BiasModel errors;
  TrackFilter filter = filter_at(path(0.0));
  const auto measurements = flight(2.0, 1e-4);
  for (const BearingMeasurement& s : measurements) feed(filter, s, errors);
  BearingMeasurement wild = measurements.back();
  wild.sight.direction.elevation_rad += 0.05;
  const Vector3d before = filter.position();
  EXPECT_EQ(feed(filter, wild, errors), BearingUse::kRejected);
  EXPECT_EQ(filter.position(), before);
  wild.sight.direction.azimuth_rad = wrap_two_pi(wild.sight.direction.azimuth_rad + kPi);
  EXPECT_EQ(feed(filter, wild, errors), BearingUse::kBehindCamera);
}

TEST(TrackFilter, FollowsAManoeuvreBeyondItsModels) {
  BiasModel errors;
  TrackFilter filter = filter_at(path(0.0));
  const auto corner = [](double t_s) {
    const double after_s = std::max(0.0, t_s - 2.0);
    return Vector3d(path(std::min(t_s, 2.0)) + after_s * Vector3d(-40, 30, 0));
  };
  for (int i = 0; i < 300; ++i) {
    const double t_s = i / 60.0;
    const auto k = static_cast<std::size_t>(i % 4);
    feed(filter,
         measurement_of(
             ray_to(std::string(1, static_cast<char>('a' + i % 4)), square()[k], corner(t_s), 1e-4),
             kStart + std::llround(t_s * 1e6)),
         errors);
  }
  const double t_s = 299 / 60.0;
  EXPECT_LT((filter.position() - site().to_ecef(corner(t_s))).norm(), 0.5);
}

// One station in five has an error larger than its noise, and does not declare it.
TEST(TrackFilter, ABiasIsFoundWhereTheGeometryShowsIt) {
  BiasModel errors;
  TrackFilter filter = filter_at(path(0.0));
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  const double sigma = 2e-4, bias = 8e-4;
  for (int i = 0; i < 1500; ++i) {
    const double t_s = i / 100.0;
    const auto k = static_cast<std::size_t>(i % 4);
    Ray ray =
        ray_to(std::string(1, static_cast<char>('a' + i % 4)), square()[k], path(0.5 * t_s), sigma);
    ray = test::turned(ray, sigma * normal(random), sigma * normal(random) + (k == 2 ? bias : 0.0));
    feed(filter, measurement_of(ray, kStart + std::llround(t_s * 1e6)), errors);
  }
  for (std::size_t i = 0; i < filter.stations().size(); ++i) {
    const StationBias found = filter.bias(i);
    const bool off = filter.stations()[i].station == "c";
    EXPECT_EQ(found.bias_rad.y() > 0.4 * bias, off);
    const double truth = off ? bias : 0.0;
    EXPECT_LT(std::abs(found.bias_rad.y() - truth), 4.0 * std::sqrt(found.covariance_rad2(1, 1)));
  }
}

// Systematic errors do not average out: the covariance contains the stations' statements.
TEST(TrackFilter, AveragingDoesNotMakeABadHeadingGoAway) {
  BiasModel errors;
  TrackFilter filter = filter_at({0.0, 300.0, 50.0});
  const double heading = 3e-3;
  for (int i = 0; i < 4000; ++i) {
    const auto k = static_cast<std::size_t>(i % 2);
    Ray ray = ray_to(k == 0 ? "a" : "b", square()[k], {0.0, 300.0, 50.0}, 1e-4);
    ray.sight.covariance_systematic = Eigen::Matrix2d::Identity() * heading * heading;
    feed(filter, measurement_of(ray, kStart + i * 10'000), errors);
  }
  const Eigen::Matrix3d P = filter.summary().covariance.topLeftCorner<3, 3>();
  const double range_m = Vector3d(200.0, 500.0, 50.0).norm();
  EXPECT_GT(std::sqrt(P.trace()), heading * range_m);
  EXPECT_GT(filter.systematic().all_m2.trace(), 0.8 * P.trace());
}

TEST(TrackFilter, TellsWhatErrorsThatNobodyStatedMakeOfItsCovariance) {
  BiasModel errors;
  TrackFilter filter = filter_at(path(0.0));
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::array<Eigen::Vector2d, 4> biases;
  for (auto& bias : biases) bias = 1e-3 * Eigen::Vector2d(normal(random), normal(random));
  TrackFilter declaring = filter_at(path(0.0));
  for (const BearingMeasurement& s : flight(0.5, 1e-4)) feed(filter, s, errors);
  for (BearingMeasurement s : flight(0.5, 1e-4)) {
    s.sight.covariance_systematic = Eigen::Matrix2d::Identity() * 1e-6;
    feed(declaring, s, errors);
  }
  EXPECT_LT(declaring.systematic().empirical_m2.trace(),
            0.1 * declaring.systematic().all_m2.trace());
  for (int i = 0; i < 1200; ++i) {
    const auto k = static_cast<std::size_t>(i % 4);
    Ray ray =
        ray_to(std::string(1, static_cast<char>('a' + i % 4)), square()[k], path(i / 60.0), 1e-4);
    ray = test::turned(ray, biases[k].x(), biases[k].y());
    feed(filter, measurement_of(ray, kStart + std::llround(i / 60.0 * 1e6)), errors);
  }
  const SystematicPart part = filter.systematic();
  EXPECT_GT(part.empirical_m2.trace(), 0.5 * part.all_m2.trace());
}

// The thirteenth station's bearings that a filter has used; and how many stations it counts.
std::pair<int, int> used_and_stations(const TrackFilter& filter) {
  int used = 0, stations = 0;
  filter.each_station([&](const FilterStation& station) {
    ++stations;
    if (station.station == "m") used += station.used;
  });
  return {used, stations};
}

// Twelve have states; the bias of a thirteenth counts as noise until one of them is silent.
TEST(TrackFilter, AThirteenthStationCountsWithoutStates) {
  const auto bearing = [](int station, double t_s) {
    const double angle = 2.0 * kPi * station / 13.0;
    const Vector3d place(300.0 * std::cos(angle), 300.0 * std::sin(angle), 0.0);
    return measurement_of(
        ray_to(std::string(1, static_cast<char>('a' + station)), place, path(t_s)),
        kStart + std::llround(t_s * 1e6));
  };
  BiasModel errors;
  TrackFilter filter = filter_at(path(0.0));
  double t_s = 0.0;
  for (; t_s < 2.0; t_s += 0.1) {
    for (int i = 0; i < 12; ++i)
      EXPECT_EQ(feed(filter, bearing(i, t_s), errors), BearingUse::kUsed);
    const double before_m2 = filter.summary().covariance.topLeftCorner<3, 3>().trace();
    EXPECT_EQ(feed(filter, bearing(12, t_s), errors), BearingUse::kUsed);
    const double after_m2 = filter.summary().covariance.topLeftCorner<3, 3>().trace();
    EXPECT_LT(after_m2, before_m2);
    EXPECT_GT(after_m2, 0.9 * before_m2);
    EXPECT_EQ(filter.stations().size(), 12U);
    BearingMeasurement beside = bearing(12, t_s);
    beside.sight.direction.elevation_rad += 0.05;
    EXPECT_EQ(feed(filter, beside, errors), BearingUse::kRejected);
  }
  EXPECT_EQ(used_and_stations(filter), std::make_pair(20, 13));
  BearingUse last = BearingUse::kRejected;
  for (const double end_s = t_s + 1.2; t_s < end_s; t_s += 0.1) {
    for (int i = 1; i < 12; ++i) feed(filter, bearing(i, t_s), errors);
    last = feed(filter, bearing(12, t_s), errors);
  }
  EXPECT_EQ(last, BearingUse::kUsed);
  EXPECT_EQ(filter.stations().front().station, "m");
  EXPECT_EQ(used_and_stations(filter).second, 12);
  EXPECT_LT(error(filter, filter.utime_us()).norm(), 0.1);
}

TEST(TrackFilter, AClockThatWasBadForAMomentIsForgiven) {
  const auto sd_m = [](double clock_sd_s) {
    BiasModel errors;
    TrackFilter filter = filter_at(path(0.0));
    for (BearingMeasurement s : flight(20.0, 1e-4, 1e-4)) {
      s.clock_sd_s = s.utime_us < kStart + 1'000'000 ? clock_sd_s : 1e-4;
      feed(filter, s, errors);
    }
    return std::sqrt(filter.summary().covariance.topLeftCorner<3, 3>().trace());
  };
  const double always_good_m = sd_m(1e-4);
  EXPECT_LT(sd_m(0.05), 1.5 * always_good_m);
}

// Walks to and fro 50 to 200 m in front of adjacent stations with heading errors as stated: a bias
// that the short base makes unobservable must not be learnt from small non-linearities.
struct ShortBase : testing::TestWithParam<std::vector<double>> {
  static Vector3d walker(double t_s) {
    return {20.0 * std::sin(0.07 * t_s), 125.0 + 75.0 * std::sin(0.05 * t_s), 2.0};
  }
};

TEST_P(ShortBase, IsAsUnsureAsItsHeadingsAre) {
  constexpr double kHeadingSd = 2e-3, kPixelSd = 2e-5;
  double nees = 0.0, error_m2 = 0.0, variance_m2 = 0.0;
  int judged = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    std::vector<double> heading_off;
    for (std::size_t i = 0; i < GetParam().size(); ++i)
      heading_off.push_back(kHeadingSd * normal(random));
    BiasModel errors;
    TrackFilter filter = filter_at(walker(0.0));
    for (int frame = 0; frame < 15 * 90; ++frame) {
      const double t_s = frame / 15.0;
      const std::int64_t utime_us = kStart + std::llround(t_s * 1e6);
      for (std::size_t i = 0; i < GetParam().size(); ++i) {
        Ray ray = ray_to(std::string(1, static_cast<char>('a' + i)), {GetParam()[i], 0.0, 0.0},
                         walker(t_s), kPixelSd);
        ray = test::turned(ray, heading_off[i] + kPixelSd * normal(random),
                           kPixelSd * normal(random));
        ray.sight.covariance_systematic(0, 0) = kHeadingSd * kHeadingSd;
        feed(filter, measurement_of(ray, utime_us), errors);
      }
      if (frame < 15 * 10 || frame % 15 != 0) continue;
      const Vector3d off = filter.position() - site().to_ecef(walker(t_s));
      const Eigen::Matrix3d P = filter.summary().covariance.topLeftCorner<3, 3>();
      nees += off.dot(P.llt().solve(off)) / 3.0;
      error_m2 += off.squaredNorm();
      variance_m2 += P.trace();
      ++judged;
    }
  }
  EXPECT_GT(nees / judged, 0.3);
  EXPECT_LT(nees / judged, 2.0);
  EXPECT_LT(std::sqrt(error_m2 / variance_m2), 1.3);
}

INSTANTIATE_TEST_SUITE_P(Bases, ShortBase,
                         testing::Values(std::vector<double>{-15.0, 15.0},
                                         std::vector<double>{-30.0, 0.0, 30.0},
                                         std::vector<double>{-300.0, 300.0}));

TEST(TrackFilter, KeepsItsCovarianceDefinite) {
  BiasModel errors;
  TrackFilter filter = filter_at(path(0.0));
  for (const BearingMeasurement& s : flight(20.0, 1e-5)) feed(filter, s, errors);
  const FilterMatrix P = filter.mixed().covariance;
  const FilterMatrix known = P.topLeftCorner(9, 9);
  EXPECT_TRUE(known.llt().info() == Eigen::Success);
  double sum = 0.0;
  for (const double p : filter.probabilities()) sum += p;
  EXPECT_NEAR(sum, 1.0, 1e-12);
}

}  // namespace
}  // namespace ols::fusion
