// Whether a geometry determines a position. Where it hardly does, the matrices are singular to
// rounding: an inverse of one is finite and has negative variances. Pure.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "central/measurement/ray.h"

namespace ols::fusion {

// The inverse of an information matrix, positive definite; nullopt where its smallest eigenvalue is
// zero to rounding (below 1e-13 of the largest) or it is not finite: some direction is not
// observable.
std::optional<Eigen::Matrix3d> covariance_from(const Eigen::Matrix3d& information);

// Finite, and positive definite by more than rounding.
bool is_covariance(const Eigen::Matrix3d& covariance);

// The same estimate; "parallel rays" without a position where its covariance is none. Where that of
// the velocity is none, there is no velocity. The white part, a difference, loses what rounding
// made negative.
Estimate checked(Estimate estimate);

}  // namespace ols::fusion
