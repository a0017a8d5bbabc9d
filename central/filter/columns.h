// The loops over a covariance's columns in which a filter spends most of its time. P is n x n,
// column-major; only its lower triangle is touched. Pure.
//
// They are compiled twice: a processor with AVX takes twice as many elements at once. Each element
// is computed separately, by the same operations in the same order, so both versions give the same
// bits.
#pragma once

#include <Eigen/Core>
#include <array>

#include "central/filter/motion_model.h"

namespace ols::fusion::columns {

// Computes P - g0 g0^T - g1 g1^T in the first columns.
void subtract_square(const double* g0, const double* g1, Eigen::Index columns, Eigen::Index n,
                     double* P);

// Multiplies whole columns (position, velocity and acceleration on one axis) by f^T.
struct AxisColumns {
  double *position, *velocity, *acceleration;
};
void propagate(const Eigen::Matrix3d& f, Eigen::Index n, const AxisColumns& columns);

// Multiplies each row and each column by its own factor.
void scale(const double* factors, Eigen::Index n, double* P);

// One part of a mixture. `covariance`: a column of the part's covariance, from the diagonal on.
// `off`: the offset of the part's mean from the mixture's mean. `weighted_off`: the part's weight
// times the first element of that offset.
struct Part {
  const double *covariance, *off;
  double weight, weighted_off;
};
using Parts = std::array<Part, kMotions>;
// Writes n elements of the mixture's column.
void mix(const Parts& parts, Eigen::Index n, double* result);

}  // namespace ols::fusion::columns
