// The operations on the lower triangle, compared with the formulas on whole matrices.
#include "central/filter/filter_gaussian.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace ols::fusion {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kNotKept = 1e30;  // the part above the diagonal must not matter
constexpr Eigen::Index kStates = 9 + 2 * kPoseStates + kPlaceStates;

class FilterGaussianTest : public testing::Test {
 protected:
  MatrixXd random(Eigen::Index rows, Eigen::Index columns) {
    return MatrixXd::NullaryExpr(rows, columns, [this] { return normal_(engine_); });
  }
  MatrixXd covariance() {
    const MatrixXd root = random(kStates, kStates);
    const MatrixXd product = root * root.transpose();
    // Symmetric to the last bit, which the product is not on every machine.
    return product.selfadjointView<Eigen::Lower>();
  }

 private:
  std::mt19937_64 engine_{1};
  std::normal_distribution<double> normal_;
};

FilterMatrix kept(const MatrixXd& whole) {
  FilterMatrix P = FilterMatrix::Constant(whole.rows(), whole.cols(), kNotKept);
  P.triangularView<Eigen::Lower>() = whole;
  return P;
}

MatrixXd whole(const FilterMatrix& P) { return P.selfadjointView<Eigen::Lower>(); }

TEST_F(FilterGaussianTest, AddsAProductWithAFewColumns) {
  const MatrixXd P = covariance();
  for (const Eigen::Index first : {0, 3, 9, 13, 17}) {
    const Eigen::Matrix<double, 2, 3> part = random(2, 3);
    MatrixXd H = MatrixXd::Zero(2, kStates);
    H.middleCols<3>(first) = part;
    const MatrixXd before = random(kStates, 2);
    FilterMatrix2 result = before;
    add_product<3>(kept(P), first, part, result);
    EXPECT_TRUE(MatrixXd(result).isApprox(before + P * H.transpose(), 1e-12)) << first;
  }
}

TEST_F(FilterGaussianTest, SubtractsASquareAndOnlyConsidersTheRest) {
  const MatrixXd P = covariance(), G = random(kStates, 2);
  FilterMatrix all = kept(P), some = kept(P);
  subtract_square(G, kStates, all);
  EXPECT_TRUE(whole(all).isApprox(P - G * G.transpose(), 1e-12));
  subtract_square(G, 9, some);
  MatrixXd expected = P - G * G.transpose();
  expected.bottomRightCorner(kStates - 9, kStates - 9) =
      P.bottomRightCorner(kStates - 9, kStates - 9);
  EXPECT_TRUE(whole(some).isApprox(expected, 1e-12));
}

TEST_F(FilterGaussianTest, PropagatesTheTargetAndItsShareInTheStations) {
  Vector9 target;
  target << 1e6, 2e6, 3e6, 20.0, -10.0, 5.0, 3.0, 4.0, -1.0;
  for (const Motion motion :
       {Motion::kConstantVelocity, Motion::kCoordinatedTurn, Motion::kAcceleration}) {
    const Transition t = transition(motion, target, 0.7, {});
    MatrixXd F = MatrixXd::Identity(kStates, kStates), Q = MatrixXd::Zero(kStates, kStates);
    for (int i = 0; i < 9; ++i) {
      for (int j = 0; j < 9; ++j) {
        F(i, j) = i % 3 == j % 3 ? t.f(i / 3, j / 3) : 0.0;
        Q(i, j) = t.q(i / 3, j / 3) * t.directions(i % 3, j % 3);
      }
    }
    const MatrixXd P = covariance();
    const VectorXd mean = random(kStates, 1);
    FilterGaussian state{mean, kept(P)};
    propagate(t, state);
    EXPECT_TRUE(VectorXd(state.mean).isApprox(F * mean, 1e-12));
    EXPECT_TRUE(whole(state.covariance).isApprox(F * P * F.transpose() + Q, 1e-12));
  }
}

TEST_F(FilterGaussianTest, ScalesEachState) {
  const MatrixXd P = covariance();
  const VectorXd mean = random(kStates, 1), factors = random(kStates, 1);
  FilterGaussian state{mean, kept(P)};
  scale(factors, state);
  EXPECT_TRUE(VectorXd(state.mean).isApprox(factors.cwiseProduct(mean), 1e-12));
  EXPECT_TRUE(whole(state.covariance).isApprox(factors.asDiagonal() * P * factors.asDiagonal()));
}

TEST_F(FilterGaussianTest, InsertsStatesThatAreZero) {
  const MatrixXd P = covariance();
  const VectorXd mean = random(kStates, 1);
  FilterGaussian state{mean, kept(P)};
  insert_states(13, 3, state);
  ASSERT_EQ(state.mean.size(), kStates + 3);
  const Eigen::Index rest = kStates - 13;
  const MatrixXd after = whole(state.covariance);
  EXPECT_EQ(state.mean.head(13), mean.head(13));
  EXPECT_EQ(state.mean.tail(rest), mean.tail(rest));
  EXPECT_TRUE(state.mean.segment(13, 3).isZero(0.0));
  EXPECT_TRUE(after.middleRows(13, 3).isZero(0.0));
  EXPECT_EQ(after.topLeftCorner(13, 13), P.topLeftCorner(13, 13));
  EXPECT_EQ(after.bottomLeftCorner(rest, 13), P.bottomLeftCorner(rest, 13));
  EXPECT_EQ(after.bottomRightCorner(rest, rest), P.bottomRightCorner(rest, rest));
}

TEST_F(FilterGaussianTest, MixesMeansAndCovariances) {
  const std::array<std::array<MixtureWeights, kMotions>, 2> of_two_and_three = {
      {{{{0.6, 0.4, 0.0}, {0.1, 0.9, 0.0}, {}}},
       {{{0.5, 0.3, 0.2}, {0.1, 0.8, 0.1}, {0.25, 0.0, 0.75}}}}};
  for (std::size_t count = 2; count <= 3; ++count) {
    const auto& weights = of_two_and_three[count - 2];
    std::vector<MatrixXd> P;
    std::vector<VectorXd> means;
    std::vector<FilterGaussian> parts;
    for (std::size_t i = 0; i < count; ++i) {
      P.push_back(covariance());
      means.emplace_back(random(kStates, 1));
      parts.push_back({means[i], kept(P[i])});
    }
    std::vector<FilterGaussian> mixed = parts;
    interact(weights, mixed);
    for (std::size_t to = 0; to < count; ++to) {
      VectorXd mean = VectorXd::Zero(kStates);
      MatrixXd expected = MatrixXd::Zero(kStates, kStates);
      for (std::size_t i = 0; i < count; ++i) mean += weights[to][i] * means[i];
      for (std::size_t i = 0; i < count; ++i) {
        expected += weights[to][i] * (P[i] + (means[i] - mean) * (means[i] - mean).transpose());
      }
      EXPECT_TRUE(VectorXd(mixed[to].mean).isApprox(mean, 1e-12));
      EXPECT_TRUE(whole(mixed[to].covariance).isApprox(expected, 1e-12));
      const FilterGaussian one = mixture(parts, weights[to]);
      EXPECT_TRUE(VectorXd(one.mean).isApprox(mean, 1e-12));
      EXPECT_TRUE(MatrixXd(one.covariance).isApprox(expected, 1e-12));
      const TargetGaussian target =
          target_mixture(std::span<const FilterGaussian>(parts), weights[to]);
      EXPECT_TRUE(VectorXd(target.mean).isApprox(mean.head(9), 1e-12));
      EXPECT_TRUE(MatrixXd(target.covariance).isApprox(expected.topLeftCorner(9, 9), 1e-12));
    }
  }
}

}  // namespace
}  // namespace ols::fusion
