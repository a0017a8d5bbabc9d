#include "central/estimators/position_covariance.h"

#include <gtest/gtest.h>

#include <limits>

namespace ols::fusion {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d diagonal(double a, double b, double c) { return Vector3d(a, b, c).asDiagonal(); }

Estimate a_position() {
  Estimate estimate;
  estimate.solution = Solution::kOk;
  estimate.position_ecef = {4e6, 1e6, 4.8e6};
  estimate.covariance_ecef = diagonal(1.0, 2.0, 3.0);
  estimate.covariance_white_ecef = diagonal(0.5, 1.0, 2.0);
  estimate.rays.resize(2);
  return estimate;
}

TEST(PositionCovariance, InvertsTheInformation) {
  Matrix3d information = diagonal(4.0, 5.0, 6.0);
  information(0, 1) = information(1, 0) = 1.0;
  const auto covariance = covariance_from(information);
  ASSERT_TRUE(covariance.has_value());
  EXPECT_TRUE((*covariance * information).isIdentity(1e-12));
}

TEST(PositionCovariance, HasNoneWhereADirectionIsNotObservable) {
  const Vector3d along = Vector3d(1.0, 2.0, 3.0).normalized();
  const Matrix3d across = 1e8 * (Matrix3d::Identity() - along * along.transpose());
  EXPECT_FALSE(covariance_from(across).has_value());
  EXPECT_FALSE(covariance_from(diagonal(1.0, 1.0, 1e-14)).has_value());
  EXPECT_TRUE(covariance_from(diagonal(1.0, 1.0, 1e-12)).has_value());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(covariance_from(diagonal(1.0, nan, 1.0)).has_value());
}

TEST(PositionCovariance, LeavesAGoodEstimateAlone) {
  const Estimate estimate = checked(a_position());
  EXPECT_EQ(estimate.solution, Solution::kOk);
  EXPECT_EQ(estimate.position_ecef, a_position().position_ecef);
  EXPECT_EQ(estimate.covariance_white_ecef, a_position().covariance_white_ecef);
}

TEST(PositionCovariance, TakesThePositionBackWhereItsCovarianceIsNone) {
  Estimate estimate = a_position();
  estimate.covariance_ecef(2, 2) = -1e-9;
  const Estimate none = checked(estimate);
  EXPECT_EQ(none.solution, Solution::kParallelRays);
  EXPECT_FALSE(none.position_ecef.allFinite());
  EXPECT_EQ(none.rays.size(), 2U);
}

TEST(PositionCovariance, RoundsNegativeWhiteVariancesToZero) {
  Estimate estimate = a_position();
  estimate.covariance_white_ecef = diagonal(1.0, 1.0, -1e-12);
  EXPECT_TRUE(checked(estimate).covariance_white_ecef.isApprox(diagonal(1.0, 1.0, 0.0)));
}

}  // namespace
}  // namespace ols::fusion
