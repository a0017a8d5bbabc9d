#include "central/estimators/position_covariance.h"

#include <Eigen/Eigenvalues>
#include <utility>

namespace ols::fusion {
namespace {

using Eigen::Matrix3d;
using Eigensystem = Eigen::SelfAdjointEigenSolver<Matrix3d>;

// Eigenvalues are exact to about 2e-16 of the largest one.
constexpr double kRounding = 1e-13;

bool has_rank(const Eigensystem& eigen) {
  return eigen.eigenvalues()(0) > kRounding * eigen.eigenvalues()(2);
}

Matrix3d without_negative_variances(const Matrix3d& white) {
  if (!white.allFinite()) return white;
  const Eigensystem eigen(white);
  if (eigen.eigenvalues()(0) >= 0.0) return white;
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).asDiagonal() *
         eigen.eigenvectors().transpose();
}

}  // namespace

std::optional<Matrix3d> covariance_from(const Matrix3d& information) {
  if (!information.allFinite()) return std::nullopt;
  const Eigensystem eigen(information);
  if (!has_rank(eigen)) return std::nullopt;
  const Matrix3d covariance = eigen.eigenvectors() *
                              eigen.eigenvalues().cwiseInverse().asDiagonal() *
                              eigen.eigenvectors().transpose();
  if (!covariance.allFinite()) return std::nullopt;
  return (covariance + covariance.transpose()) / 2.0;
}

bool is_covariance(const Matrix3d& covariance) {
  return covariance.allFinite() && has_rank(Eigensystem(covariance, Eigen::EigenvaluesOnly));
}

Estimate checked(Estimate estimate) {
  if (estimate.solution != Solution::kOk) return estimate;
  if (!estimate.position_ecef.allFinite() || !is_covariance(estimate.covariance_ecef)) {
    Estimate none;
    none.solution = Solution::kParallelRays;
    none.rays = std::move(estimate.rays);
    return none;
  }
  estimate.covariance_white_ecef = without_negative_variances(estimate.covariance_white_ecef);
  if (!estimate.velocity_ecef.allFinite() || !is_covariance(estimate.velocity_covariance_ecef)) {
    estimate.velocity_ecef = nan_vector();
    estimate.velocity_covariance_ecef = nan_matrix();
  }
  return estimate;
}

}  // namespace ols::fusion
