#include "central/station_errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "central/track_filter.h"
#include "flight.h"

namespace ols {
namespace {

using test::flight;

constexpr double kNoise = 1e-4;

SightLine sight() {
  SightLine line = flight(0.1, kNoise).front().sight;
  line.covariance_systematic.setZero();
  return line;
}

// Biases of this size, each drawn anew, seen with an error of this size as the filter would.
double learnt_sd(double bias_sd, double error_sd) {
  StationErrors errors;
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  const SightLine line = sight();
  for (int i = 0; i < 2000; ++i) {
    SeenBias seen;
    seen.prior = errors.prior("a", line, 500.0).covariance.diagonal();
    const Eigen::Array2d gain = seen.prior / (seen.prior + error_sd * error_sd);
    const double x = normal(random), y = normal(random), z = normal(random), w = normal(random);
    seen.value = gain * (bias_sd * Eigen::Array2d(x, y) + error_sd * Eigen::Array2d(z, w));
    seen.variance = seen.prior * (1.0 - gain);
    errors.observe("a", line, seen, StationErrorsConfig{}.untold_time_s, 500.0);
  }
  return std::sqrt(errors.prior("a", line, 500.0).covariance.trace() / 2.0);
}

TEST(StationErrors, LearnTheBiasesSizeFromWhatTheGeometryShows) {
  EXPECT_NEAR(learnt_sd(5e-4, 1e-5), 5e-4, 1e-4);
  EXPECT_NEAR(learnt_sd(5e-4, 5e-4), 5e-4, 1.5e-4);
  EXPECT_LT(learnt_sd(1e-6, 1e-5), 0.25 * kNoise);
}

TEST(StationErrors, KeepTheGuessWhereTheGeometryShowsNothing) {
  const double guess = StationErrorsConfig{}.untold_over_noise * kNoise;
  EXPECT_NEAR(learnt_sd(0.0, 1.0), guess, 0.01 * guess);
}

TEST(StationErrors, ForgetAStation) {
  StationErrors errors;
  const double before = errors.prior("a", sight(), 500.0).covariance.trace();
  const SeenBias far{.value = {1e-2, 1e-2}, .variance = {1e-12, 1e-12}, .prior = {1e-8, 1e-8}};
  errors.observe("a", sight(), far, 1.0, 500.0);
  errors.observe_residual("a", 50.0);
  EXPECT_GT(errors.prior("a", sight(), 500.0).covariance.trace(), 100.0 * before);
  EXPECT_GT(errors.noise_scale("a"), 1.5);
  errors.forget("a");
  EXPECT_NEAR(errors.prior("a", sight(), 500.0).covariance.trace(), before, 1e-6 * before);
  EXPECT_EQ(errors.noise_scale("a"), 1.0);
}

TEST(StationErrors, SupposeTwoTimesForAStatedBiasAndOneForWhatNobodyTold) {
  const StationErrorsConfig config;
  const StationErrors errors(config);
  const BiasPrior untold = errors.prior("a", sight(), 500.0);
  for (const Eigen::Array2d& time_s : untold.time_s) {
    EXPECT_TRUE((time_s == config.untold_time_s).all());
  }
  SightLine stated = sight();
  stated.covariance_systematic = Eigen::Vector2d(1e-6, 1e-6).asDiagonal();
  const BiasPrior alike = errors.prior("a", stated, 500.0);
  EXPECT_TRUE(alike.time_s[0].isApproxToConstant(config.stated_time_s, 1e-6));
  EXPECT_TRUE(alike.time_s[1].isApproxToConstant(config.stated_slow_s, 1e-6));
}

// Four times the variance on the first axis: three of it are a heading's.
TEST(StationErrors, TakeForAHeadingWhatOneAxisHasMore) {
  SightLine stated = sight();
  stated.covariance_systematic = Eigen::Vector2d(4e-6, 1e-6).asDiagonal();
  const BiasPrior prior = StationErrors().prior("a", stated, 500.0);
  for (const Eigen::Array2d& time_s : prior.time_s) {
    EXPECT_NEAR(time_s(0) / time_s(1), 4.0, 1e-3);
    // As much is new on either axis in the same time.
    const Eigen::Array2d fresh = prior.covariance.diagonal().array() / time_s;
    EXPECT_NEAR(fresh(0) / fresh(1), 1.0, 1e-9);
  }
}

class NoiseScale : public testing::TestWithParam<double> {};

// A station's noise is found, be it less or more than what it states.
TEST_P(NoiseScale, IsFoundFromTheResiduals) {
  StationErrors errors;
  TrackFilter filter({}, test::kStart,
                     {.p_ecef = test::site().to_ecef(test::path(0.0)),
                      .position_sd_m = 10.0,
                      .velocity_sd_m_s = 50.0});
  for (const Sighting& s : flight(60.0, kNoise, GetParam() * kNoise)) filter.update(s, errors);
  const double variance = GetParam() * GetParam();
  EXPECT_NEAR(errors.noise_scale("b") / variance, 1.0, 0.3);
}

INSTANTIATE_TEST_SUITE_P(OverStated, NoiseScale, testing::Values(0.5, 1.0, 2.0, 3.0, 8.0));

}  // namespace
}  // namespace ols
