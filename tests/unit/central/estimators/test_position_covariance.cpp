#include <gtest/gtest.h>

#include "central/estimators/position_covariance.h"

namespace ols::fusion {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

TEST(PositionCovariance, IsTheInverseOfAnInformationOfFullRank) {
  Matrix3d information;
  information << 4.0, 1.0, 0.5, 1.0, 3.0, 0.2, 0.5, 0.2, 2.0;
  const auto covariance = covariance_from(information);
  ASSERT_TRUE(covariance);
  EXPECT_LT((*covariance * information - Matrix3d::Identity()).norm(), 1e-12);
  EXPECT_TRUE(is_covariance(*covariance));
}

TEST(PositionCovariance, IsNothingWhereADirectionIsNotObservable) {
  const Vector3d along = Vector3d(1, 2, 3).normalized();
  const Matrix3d across = Matrix3d::Identity() - along * along.transpose();
  EXPECT_FALSE(covariance_from(across));
  EXPECT_FALSE(covariance_from(nan_matrix()));
  EXPECT_TRUE(covariance_from(across + 1e-9 * along * along.transpose()));
  EXPECT_FALSE(is_covariance(across));
}

TEST(PositionCovariance, ChecksAnEstimate) {
  Estimate estimate;
  estimate.solution = Solution::kOk;
  estimate.position_ecef.setZero();
  estimate.covariance_ecef.setIdentity();
  estimate.covariance_white_ecef = Vector3d(1.0, 0.5, -1e-9).asDiagonal();
  estimate.velocity_ecef.setZero();
  estimate.velocity_covariance_ecef = Vector3d(1.0, 1.0, 0.0).asDiagonal();
  const Estimate good = checked(estimate);
  EXPECT_EQ(good.solution, Solution::kOk);
  EXPECT_GE(good.covariance_white_ecef(2, 2), 0.0);
  EXPECT_FALSE(good.velocity_ecef.allFinite());
  estimate.covariance_ecef(2, 2) = -1e-3;
  const Estimate bad = checked(estimate);
  EXPECT_EQ(bad.solution, Solution::kParallelRays);
  EXPECT_FALSE(bad.position_ecef.allFinite());
}

}  // namespace
}  // namespace ols::fusion
