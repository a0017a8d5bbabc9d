#include "calibration/block.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <random>

#include "tests/unit/calibration/scene.h"
#include "tests/unit/geometry/near.h"

namespace ols::calibration {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using ols::test::near;

constexpr unsigned kSeed = 20260118;

// A random symmetric positive definite matrix.
MatrixXd normal_matrix(std::mt19937& random, Eigen::Index size) {
  std::normal_distribution<double> normal;
  MatrixXd A(size + 3, size);
  for (double& value : A.reshaped()) value = normal(random);
  return A.transpose() * A;
}

TEST(Eliminated, TheInverseOfItsInformationIsThatOfTheWhole) {
  std::mt19937 random(kSeed);
  const MatrixXd N = normal_matrix(random, 7);
  const VectorXd b = N * VectorXd::LinSpaced(7, -1.0, 2.0);
  const BlockEquations block = eliminated(N, b, 20.0, 4, 0, 0.0);
  const MatrixXd whole = N.inverse();
  EXPECT_TRUE(near(block.information.inverse(), whole.topLeftCorner(4, 4), 1e-9));
  // One step solves the linear problem, the nuisance with it.
  const VectorXd dx = -block.information.ldlt().solve(block.gradient);
  const VectorXd nuisance = -(block.nuisance_step + block.nuisance_by * dx);
  VectorXd step(7);
  step << dx, nuisance;
  EXPECT_TRUE(near(step, -VectorXd::LinSpaced(7, -1.0, 2.0), 1e-9));
  EXPECT_NEAR(block.squares - block.gradient.dot(block.information.ldlt().solve(block.gradient)),
              20.0 - b.dot(whole * b), 1e-9);
}

TEST(Eliminated, AShiftIsSeenThroughTheNuisance) {
  std::mt19937 random(kSeed + 1);
  const MatrixXd N = normal_matrix(random, 8);
  const BlockEquations block = eliminated(N, VectorXd::Zero(8), 0.0, 3, 2, 0.0);
  MatrixXd reduced(5, 5);
  reduced << block.information, block.shift_by, block.shift_by.transpose(), block.shift_information;
  EXPECT_TRUE(near(reduced.inverse(), N.inverse().topLeftCorner(5, 5), 1e-9));
}

TEST(StationPrior, CorrelatedParametersAreOne) {
  StationMatrix covariance = StationMatrix::Zero();
  covariance(kMountZ, kMountZ) = 4e-6;
  covariance(kCx, kCx) = 9.0;
  covariance(kMountZ, kCx) = covariance(kCx, kMountZ) = -0.999 * 2e-3 * 3.0;
  const BlockPtr block = station_prior_block({1, 0}, 0, covariance);
  State state;
  state.stations = {station_at({.model = test::hill()}, StationVector::Zero())};
  // Along the correlation a step of one sigma costs one, against it two thousand.
  state.stations[0].change[kMountZ] = 2e-3;
  state.stations[0].change[kCx] = -3.0;
  EXPECT_NEAR(block->equations(state, 0, 0.0).squares, 1.0, 0.01);
  state.stations[0].change[kCx] = 3.0;
  EXPECT_NEAR(block->equations(state, 0, 0.0).squares, 2000.0, 1.0);
  EXPECT_EQ(block->degrees_of_freedom(), 2);
}

// Their zero is one unknown of both: it costs once.
TEST(Level, ReadingsAreAsWrongAsTheirNoiseAndTheirZero) {
  Observation reading;
  reading.tilt_rad = {1e-3, 0.0};
  reading.tilt_sd_rad = 1e-4;
  reading.zero_sd_rad = 2e-4;
  State state;
  state.stations = {station_at({.model = test::hill()}, StationVector::Zero())};
  state.nuisances = {VectorXd::Zero(2)};
  for (const std::size_t count : {1, 2}) {
    const BlockPtr block = level_block({1, 0}, std::vector<Observation>(count, reading));
    const double variance = 1e-8 / static_cast<double>(count) + 4e-8;
    EXPECT_NEAR(block->equations(state, 0, 0.0).squares, 1e-6 / variance, 1e-6) << count;
  }
}

}  // namespace
}  // namespace ols::calibration
