// The loops give what one element after the other gives, bit for bit, whatever the processor.
#include "central/filter/columns.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <random>

namespace ols::fusion {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

class ColumnsTest : public testing::TestWithParam<Index> {
 protected:
  MatrixXd random(Index rows, Index columns) {
    return MatrixXd::NullaryExpr(rows, columns, [this] { return normal_(engine_); });
  }
  const Index n_ = GetParam();

 private:
  std::mt19937_64 engine_{1};
  std::normal_distribution<double> normal_;
};

TEST_P(ColumnsTest, SubtractsASquareFromTheLowerTriangle) {
  const MatrixXd G = random(n_, 2), before = random(n_, n_);
  const Index columns = n_ / 2;
  MatrixXd P = before, expected = before;
  for (Index j = 0; j < columns; ++j) {
    for (Index i = j; i < n_; ++i) expected(i, j) -= G(j, 0) * G(i, 0) + G(j, 1) * G(i, 1);
  }
  columns::subtract_square(G.col(0).data(), G.col(1).data(), columns, n_, P.data());
  EXPECT_EQ(P, expected);
}

TEST_P(ColumnsTest, PropagatesAnAxis) {
  const Eigen::Matrix3d f = random(3, 3);
  MatrixXd P = random(n_, 3);
  MatrixXd expected = P;
  for (Index i = 0; i < n_; ++i) {
    expected(i, 0) = P(i, 0) + (f(0, 1) * P(i, 1) + f(0, 2) * P(i, 2));
    expected(i, 1) = f(1, 1) * P(i, 1) + f(1, 2) * P(i, 2);
    expected(i, 2) = f(2, 1) * P(i, 1) + f(2, 2) * P(i, 2);
  }
  columns::propagate(f, n_, {P.col(0).data(), P.col(1).data(), P.col(2).data()});
  EXPECT_EQ(P, expected);
}

TEST_P(ColumnsTest, ScalesTheLowerTriangle) {
  const VectorXd factors = random(n_, 1);
  MatrixXd P = random(n_, n_);
  MatrixXd expected = P;
  for (Index j = 0; j < n_; ++j) {
    for (Index i = j; i < n_; ++i) expected(i, j) *= factors(j) * factors(i);
  }
  columns::scale(factors.data(), n_, P.data());
  EXPECT_EQ(P, expected);
}

TEST_P(ColumnsTest, MixesAColumn) {
  const MatrixXd P = random(n_, 3), off = random(n_, 3), weights = random(3, 2);
  columns::Parts parts;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const auto at = static_cast<Index>(k);
    parts[k] = {P.col(at).data(), off.col(at).data(), weights(at, 0), weights(at, 1)};
  }
  VectorXd mixed = VectorXd::Constant(n_ + 1, 7.0);
  VectorXd expected = mixed;
  for (Index i = 0; i < n_; ++i) {
    const auto of = [&](Index k) { return weights(k, 0) * P(i, k) + weights(k, 1) * off(i, k); };
    expected(i) = of(0) + of(1) + of(2);
  }
  columns::mix(parts, n_, mixed.data());
  EXPECT_EQ(mixed, expected);
}

INSTANTIATE_TEST_SUITE_P(OfAnySize, ColumnsTest, testing::Values(1, 2, 3, 4, 9, 13, 41, 64, 93));

}  // namespace
}  // namespace ols::fusion
