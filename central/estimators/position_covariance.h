// Whether a geometry determines a position. If it hardly does, the matrices are singular to
// rounding: the inverse is finite but has negative variances. Pure.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "central/measurement/ray.h"

namespace ols::fusion {

// The inverse of an information matrix, positive definite. Returns nullopt where some direction is
// not observable: the matrix is not finite, or its smallest eigenvalue is zero to rounding (below
// 1e-13 of the largest).
std::optional<Eigen::Matrix3d> covariance_from(const Eigen::Matrix3d& information);

// Whether the matrix is finite, and positive definite by more than rounding.
bool is_covariance(const Eigen::Matrix3d& covariance);

// Returns the estimate with impossible parts removed. If the position's covariance is not positive
// definite: "parallel rays", no position. If the velocity's is not: no velocity. The white part is
// computed as a difference; negative variances that rounding has left in it become 0.
Estimate checked(Estimate estimate);

}  // namespace ols::fusion
