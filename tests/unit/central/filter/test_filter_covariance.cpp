#include <gtest/gtest.h>

#include "central/filter/filter_covariance.h"

namespace ols::fusion {
namespace {

using Eigen::MatrixXd;

constexpr Eigen::Index kWhole = 13;

// Each element of its own value.
MatrixXd symmetric() {
  MatrixXd whole(kWhole, kWhole);
  for (Eigen::Index i = 0; i < kWhole; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j)
      whole(i, j) = whole(j, i) = static_cast<double>(100 * i + j);
  }
  return whole;
}

TEST(FilterCovariance, KeepsEachElementOfTheLowerTriangle) {
  const MatrixXd whole = symmetric();
  FilterCovariance P(kWhole);
  EXPECT_TRUE(P.square(0, kWhole).isZero(0.0));
  for (Eigen::Index j = 0; j < kWhole; ++j) {
    for (Eigen::Index i = j; i < kWhole; ++i) P(i, j) = whole(i, j);
  }
  EXPECT_EQ(P.square(0, kWhole), whole);
  EXPECT_EQ(FilterCovariance::of(whole).square(0, kWhole), whole);
  EXPECT_EQ(P.rows(), kWhole);
}

TEST(FilterCovariance, ShowsItsParts) {
  const MatrixXd whole = symmetric();
  const FilterCovariance P = FilterCovariance::of(whole);
  EXPECT_EQ(MatrixXd(P.column(10)), MatrixXd(whole.col(10).tail(3)));
  EXPECT_EQ(MatrixXd(P.target().bottomRows(4)), MatrixXd(whole.bottomLeftCorner(4, 9)));
  EXPECT_EQ((P.square<4>(9)), (whole.block<4, 4>(9, 9)));
  EXPECT_EQ((P.block<3, 4>(10, 3)), (whole.block<3, 4>(10, 3)));
  EXPECT_EQ((P.block<2, 2>(11, 9)), (whole.block<2, 2>(11, 9)));
}

TEST(FilterCovariance, ForgetsStates) {
  MatrixXd whole = symmetric();
  FilterCovariance P = FilterCovariance::of(whole);
  P.clear(9, 3);
  whole.middleRows(9, 3).setZero();
  whole.middleCols(9, 3).setZero();
  EXPECT_EQ(P.square(0, kWhole), whole);
  P.set_variance(10, Eigen::Vector2d(5.0, 6.0));
  EXPECT_EQ(P(10, 10), 5.0);
  EXPECT_EQ(P(11, 11), 6.0);
  EXPECT_EQ(P(12, 12), whole(12, 12));
}

}  // namespace
}  // namespace ols::fusion
