// Loops over the columns of a covariance P; a filter spends most of its time in them. P is an n x n
// matrix, column-major; only its lower triangle is used. Pure.
//
// The loops are compiled twice, with and without AVX: with AVX, a processor handles twice as many
// elements at once. In both versions, each element is computed by the same operations in the same
// order. Both therefore give the same bits.
#pragma once

#include <Eigen/Core>
#include <array>

#include "central/filter/motion_model.h"

namespace ols::fusion::columns {

// Computes P - g0 g0^T - g1 g1^T for the first columns.
void subtract_square(const double* g0, const double* g1, Eigen::Index columns, Eigen::Index n,
                     double* P);

// Multiplies whole columns (position, velocity and acceleration of one axis) by f^T.
struct AxisColumns {
  double *position, *velocity, *acceleration;
};
void propagate(const Eigen::Matrix3d& f, Eigen::Index n, const AxisColumns& columns);

// Multiplies row i and column i by factors[i], for each i.
void scale(const double* factors, Eigen::Index n, double* P);

// One component of a mixture. `covariance`: a column of the component's covariance, from the
// diagonal on. `off`: the offset of the component's mean from the mixture's mean. `weighted_off`:
// the component's weight times the first element of that offset.
struct Part {
  const double *covariance, *off;
  double weight, weighted_off;
};
using Parts = std::array<Part, kMotions>;
// Writes n elements of the mixture's column.
void mix(const Parts& parts, Eigen::Index n, double* result);

}  // namespace ols::fusion::columns
