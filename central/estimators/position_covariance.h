// Decides whether a geometry determines a position. If it does not, or only barely, the information
// matrix is singular to within rounding: its inverse is finite, but may have negative variances.
// Pure.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "central/measurement/ray.h"

namespace ols::fusion {

// The inverse of an information matrix; it is positive definite. Returns nullopt if a direction is
// not observable: the information matrix is not finite, or its smallest eigenvalue is zero to
// within rounding (below 1e-13 of the largest).
std::optional<Eigen::Matrix3d> covariance_from(const Eigen::Matrix3d& information);

// Whether the matrix is finite, and positive definite by more than rounding.
bool is_covariance(const Eigen::Matrix3d& covariance);

// Returns the estimate without impossible values. If the position's covariance is not positive
// definite, the solution becomes kParallelRays and the position is removed. If the velocity's
// covariance is not positive definite, the velocity is removed. The white part of the covariance is
// a difference; its variances that are negative due to rounding become 0.
Estimate checked(Estimate estimate);

}  // namespace ols::fusion
