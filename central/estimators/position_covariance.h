// Decides whether a geometry determines a position. If it hardly does, the matrices are singular to
// within rounding: their inverse is finite, but may have negative variances. Pure.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "central/measurement/ray.h"

namespace ols::fusion {

// The inverse of an information matrix, which is positive definite. Returns nullopt if some
// direction is not observable: the matrix is not finite, or its smallest eigenvalue is zero to
// within rounding (below 1e-13 of the largest).
std::optional<Eigen::Matrix3d> covariance_from(const Eigen::Matrix3d& information);

// Whether the matrix is finite, and positive definite by more than rounding.
bool is_covariance(const Eigen::Matrix3d& covariance);

// Returns the estimate with its impossible parts removed. If the position's covariance is not
// positive definite, the solution becomes "parallel rays" and there is no position. If the
// velocity's covariance is not positive definite, there is no velocity. The white part is computed
// as a difference; negative variances due to rounding become 0.
Estimate checked(Estimate estimate);

}  // namespace ols::fusion
