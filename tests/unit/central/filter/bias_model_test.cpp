#include "central/filter/bias_model.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "central/filter/track_filter.h"
#include "tests/unit/central/flight.h"

namespace ols::fusion {
namespace {

using test::flight;

constexpr double kNoise = 1e-4;

LineOfSight sight() {
  LineOfSight line = flight(0.1, kNoise).front().sight;
  line.covariance_systematic.setZero();
  return line;
}

// Biases of this size, each drawn independently, estimated with an error of this size.
double learnt_sd(double bias_sd, double error_sd) {
  BiasModel errors;
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  const LineOfSight line = sight();
  for (int i = 0; i < 2000; ++i) {
    BiasEstimate seen;
    seen.prior = errors.prior("a", line, 500.0).covariance.diagonal();
    const Eigen::Array2d gain = seen.prior / (seen.prior + error_sd * error_sd);
    const double x = normal(random), y = normal(random), z = normal(random), w = normal(random);
    seen.value = gain * (bias_sd * Eigen::Array2d(x, y) + error_sd * Eigen::Array2d(z, w));
    seen.variance = seen.prior * (1.0 - gain);
    errors.observe("a", line, seen, BiasModelConfig{}.undeclared_time_s, 500.0);
  }
  return std::sqrt(errors.prior("a", line, 500.0).covariance.trace() / 2.0);
}

TEST(BiasModel, LearnTheBiasesSizeFromWhatTheGeometryShows) {
  EXPECT_NEAR(learnt_sd(5e-4, 1e-5), 5e-4, 1e-4);
  EXPECT_NEAR(learnt_sd(5e-4, 5e-4), 5e-4, 1.5e-4);
  EXPECT_LT(learnt_sd(1e-6, 1e-5), 0.25 * kNoise);
}

TEST(BiasModel, KeepTheGuessWhereTheGeometryShowsNothing) {
  const double guess = BiasModelConfig{}.least_over_noise * kNoise;
  EXPECT_NEAR(learnt_sd(0.0, 1.0), guess, 0.01 * guess);
}

TEST(BiasModel, NoiseThatIsNotNewInEachBearingIsBias) {
  BiasModel white, coloured;
  for (int i = 0; i < 1000; ++i) {
    white.observe_noise("a", 1.0);
    coloured.observe_noise("a", 0.01);
  }
  EXPECT_DOUBLE_EQ(white.white_share("a"), 1.0);
  EXPECT_LT(coloured.white_share("a"), 0.1);
  const double guess = std::pow(BiasModelConfig{}.least_over_noise, 2);
  const double share = coloured.prior("a", sight(), 500.0).covariance(0, 0) / (kNoise * kNoise);
  EXPECT_NEAR(share, guess + 1.0 - coloured.greatest_white_share("a"), 0.05);
  EXPECT_NEAR(white.prior("a", sight(), 500.0).covariance(0, 0), guess * kNoise * kNoise, 1e-12);
}

// What a bearing is taken with as white, and what is kept as bias, are together what is stated, or
// what shows if that is more.
TEST(BiasModel, NoVarianceIsLostBetweenNoiseAndBias) {
  for (const double shown : {0.5, 1.0, 4.0}) {
    for (const int bearings : {20, 2000}) {
      BiasModel model;
      for (int i = 0; i < bearings; ++i) {
        model.observe_noise("a", 0.1);
        model.observe_residual("a", shown / model.noise_scale("a"));
      }
      const double scale = model.noise_scale("a");
      const double white = scale * model.greatest_white_share("a");
      const double guess = std::pow(BiasModelConfig{}.least_over_noise, 2);
      const double slow =
          model.prior("a", sight(), 500.0).covariance(0, 0) / (kNoise * kNoise) - guess;
      EXPECT_NEAR(white + slow, std::max(1.0, scale), 1e-6) << shown << ' ' << bearings;
    }
  }
}

TEST(BiasModel, ForgetAStation) {
  BiasModel errors;
  const double before = errors.prior("a", sight(), 500.0).covariance.trace();
  const BiasEstimate far{.value = {1e-2, 1e-2}, .variance = {1e-12, 1e-12}, .prior = {1e-8, 1e-8}};
  errors.observe("a", sight(), far, 1.0, 500.0);
  errors.observe_residual("a", 50.0);
  EXPECT_GT(errors.prior("a", sight(), 500.0).covariance.trace(), 100.0 * before);
  EXPECT_GT(errors.noise_scale("a"), 1.5);
  errors.forget("a");
  EXPECT_NEAR(errors.prior("a", sight(), 500.0).covariance.trace(), before, 1e-6 * before);
  EXPECT_EQ(errors.noise_scale("a"), 1.0);
}

LineOfSight stated(double elevation_rad, double cross_rad2, double up_rad2) {
  LineOfSight line = sight();
  line.direction.elevation_rad = elevation_rad;
  line.covariance_systematic = Eigen::Vector2d(cross_rad2, up_rad2).asDiagonal();
  return line;
}

TEST(BiasModel, WhatIsStatedLastsAndWhatNobodyToldDoesNot) {
  const BiasModelConfig config;
  const BiasModel errors(config);
  EXPECT_EQ(errors.prior("a", sight(), 500.0).time_s, config.undeclared_time_s);
  EXPECT_EQ(errors.prior("a", stated(0.3, 1e-6, 1e-6), 500.0).time_s, config.stated_time_s);
}

// What both axes have may be fixed in the camera, or a tilt; what elevation has alone is a tilt,
// what cross-elevation has alone a heading.
TEST(BiasModel, TakesForTheCamerasWhatBothAxesHave) {
  const auto causes = [](double cross_rad2, double up_rad2) {
    const BiasPrior prior = BiasModel().prior("a", stated(0.0, cross_rad2, up_rad2), 500.0);
    return Eigen::Array4d(prior.rotation(0), prior.rotation(1), prior.rotation(2), prior.camera);
  };
  EXPECT_TRUE(causes(4e-6, 1e-6).isApprox(Eigen::Array4d(5e-7, 5e-7, 4e-6, 5e-7), 1e-9));
  EXPECT_TRUE(causes(1e-6, 4e-6).isApprox(Eigen::Array4d(3.5e-6, 3.5e-6, 1e-6, 5e-7), 1e-9));
}

// At any elevation, a rotation and a camera's error with the prior's variances make the stated
// bias.
TEST(BiasModel, ItsCausesMakeWhatIsStated) {
  for (const double elevation_rad : {-0.2, 0.0, 0.7, 1.4}) {
    const LineOfSight line = stated(elevation_rad, 5e-6, 2e-6);
    const BiasPrior prior = BiasModel().prior("a", line, 500.0);
    const auto B = shift_by_rotation(tangent_basis(line.direction));
    Eigen::Matrix2d made = B * prior.rotation.matrix().asDiagonal() * B.transpose();
    made(1, 1) += prior.camera;
    EXPECT_NEAR(made(0, 0), 5e-6, 1e-9) << elevation_rad;
    EXPECT_NEAR(made(1, 1), 2e-6, 1e-9) << elevation_rad;
    EXPECT_NEAR(made(0, 1), 0.0, 1e-12) << elevation_rad;
  }
}

TEST(BiasModel, ARotationMovesADirectionOnItsTangentPlane) {
  const AzimuthElevation d{2.0, 0.6};
  const Eigen::Vector3d rotation(3e-5, -7e-5, 5e-5);
  const Eigen::Vector3d from = enu_from_azimuth_elevation(d);
  const Eigen::Vector2d moved = tangent_basis(d).transpose() * rotation.cross(from);
  EXPECT_TRUE((shift_by_rotation(tangent_basis(d)) * rotation).isApprox(moved, 1e-12));
}

// A position error with states of its own is not part of the rotation.
TEST(BiasModel, APlaceIsPartOfTheRotationOrApart) {
  LineOfSight line = stated(0.0, 1e-6, 1e-6);
  line.origin_sd_enu_m.setConstant(1.0);
  const BiasPrior within = BiasModel().prior("a", line, 500.0);
  const BiasPrior apart = BiasModel().prior("a", line, 500.0, true);
  EXPECT_NEAR(within.rotation(0) + within.camera, 1e-6 + 1.0 / (500.0 * 500.0), 1e-12);
  EXPECT_NEAR(apart.rotation(0) + apart.camera, 1e-6, 1e-12);
  EXPECT_TRUE(apart.place_m2.isApprox(Eigen::Matrix3d::Identity(), 1e-12));
  EXPECT_TRUE(within.covariance.isApprox(apart.covariance, 1e-12));
}

// Metres across the line of sight, and less along it; the rest is as without it.
TEST(BiasModel, AnAimIsMetresAtTheTarget) {
  constexpr double kAim = 4e-4, kRangeM = 500.0, kRest = 1e-6;
  LineOfSight line = stated(0.0, kRest + kAim * kAim, kRest + kAim * kAim);
  line.direction.azimuth_rad = 0.0;
  line.aim_sd_rad = kAim;
  const BiasPrior apart = BiasModel().prior("a", line, kRangeM, true);
  const Eigen::Vector3d aim_m2 = 0.2 * 0.2 * Eigen::Vector3d(1.0, 0.04, 1.0);
  EXPECT_TRUE(apart.place_m2.isApprox(Eigen::Matrix3d(aim_m2.asDiagonal()), 1e-9));
  EXPECT_NEAR(apart.rotation(0) + apart.camera, kRest, 1e-12);
  const BiasPrior within = BiasModel().prior("a", line, kRangeM);
  EXPECT_NEAR(within.rotation(0) + within.camera, kRest + kAim * kAim, 1e-12);
}

// What is stated and does not show as noise is still there, as a bias that nothing shows.
TEST(BiasModel, WhatIsStatedAndNotSeenAsNoiseIsABias) {
  BiasModel errors;
  for (int i = 0; i < 5000; ++i) errors.observe_residual("a", 0.3 / errors.noise_scale("a"));
  EXPECT_NEAR(errors.noise_scale("a"), 0.3, 0.03);
  const Eigen::Array2d bias = errors.prior("a", sight(), 500.0).covariance.diagonal();
  const double least = std::pow(BiasModelConfig{}.least_over_noise, 2);
  EXPECT_NEAR(bias.mean() / (kNoise * kNoise), 0.7 + least, 0.05);
  BiasEstimate none{.variance = {1e-12, 1e-12}, .prior = bias};
  for (int i = 0; i < 20; ++i)
    errors.observe("a", sight(), none, BiasModelConfig{}.undeclared_time_s, 500.0);
  const Eigen::Array2d shown = errors.prior("a", sight(), 500.0).covariance.diagonal();
  EXPECT_LT(shown.mean(), 0.1 * bias.mean());
}

// Clock offsets of this size, estimated with an error of this size; over the guessed sd.
double learnt_clock(double offset_s, double error_s, double weight) {
  constexpr double kGuessS = 1e-3;
  BiasModel errors({.clock_weight = weight});
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 2000; ++i) {
    const double prior = kGuessS * kGuessS * errors.clock_scale("a");
    const double gain = prior / (prior + error_s * error_s);
    const double offset = normal(random) * offset_s, error = normal(random) * error_s;
    errors.observe_clock("a", gain * (offset + error), prior * (1.0 - gain), prior,
                         kGuessS * kGuessS, 5.0);
  }
  return std::sqrt(errors.clock_scale("a"));
}

TEST(BiasModel, LearnAGuessedClockFromWhatTheGeometryShows) {
  EXPECT_NEAR(learnt_clock(10e-3, 1e-4, 1.0), 10.0, 1.0);
  EXPECT_NEAR(learnt_clock(10e-3, 5e-3, 1.0), 10.0, 1.5);
  EXPECT_LT(learnt_clock(1e-4, 1e-3, 1.0), 1.2);
  EXPECT_EQ(learnt_clock(10e-3, 1e-4, 0.0), 1.0);
}

class NoiseScale : public testing::TestWithParam<double> {};

// A station's noise is learnt, whether smaller or larger than stated.
TEST_P(NoiseScale, IsFoundFromTheResiduals) {
  BiasModel errors;
  TrackFilter filter({}, test::kStart,
                     {.p_ecef = test::site().to_ecef(test::path(0.0)),
                      .position_sd_m = 10.0,
                      .velocity_sd_m_s = 50.0});
  for (const BearingMeasurement& s : flight(60.0, kNoise, GetParam() * kNoise))
    test::feed(filter, s, errors);
  const double variance = GetParam() * GetParam();
  EXPECT_NEAR(errors.noise_scale("b") / variance, 1.0, 0.3);
}

INSTANTIATE_TEST_SUITE_P(OverStated, NoiseScale, testing::Values(0.5, 1.0, 2.0, 3.0, 8.0));

}  // namespace
}  // namespace ols::fusion
