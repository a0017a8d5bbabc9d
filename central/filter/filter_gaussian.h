// The Gaussian of a filter's state, and the operations on it for every bearing. Pure.
//
// First come the target's nine states (motion_model.h), then those of the stations. Each function
// goes through the covariance's columns once.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "central/filter/filter_covariance.h"
#include "central/filter/motion_model.h"

namespace ols::fusion {

inline constexpr int kFilterStations = 12;  // with states of their own
// Of a station: its rotation about east, north and up, its clock's offset, and where relevant the
// error of its position (east, north, up).
inline constexpr int kPoseStates = 4, kPlaceStates = 3;
inline constexpr int kStationStates = kPoseStates + kPlaceStates;
inline constexpr int kFilterStates = 9 + kStationStates * kFilterStations;

using FilterVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kFilterStates, 1>;
using FilterMatrix2 = Eigen::Matrix<double, Eigen::Dynamic, 2, 0, kFilterStates, 2>;

struct FilterGaussian {
  FilterVector mean;
  FilterCovariance covariance;
};

// For what reads it as a whole.
struct WholeGaussian {
  FilterVector mean;
  Eigen::MatrixXd covariance;
};

// Adds P H^T for an H (2 x states) that has these columns from `first` on and is zero elsewhere;
// all of them of the target, or of the stations.
template <int K>
void add_product(const FilterCovariance& P, Eigen::Index first,
                 const Eigen::Matrix<double, 2, K>& H, FilterMatrix2& result) {
  const Eigen::Matrix<double, K, 2> Ht = H.transpose();
  const Eigen::Index after = first + K, below = P.rows() - after;
  const Eigen::Index of_target = std::min(first, kTargetStates);
  result.topRows(of_target) += P.target().block(first, 0, K, of_target).transpose().lazyProduct(Ht);
  for (Eigen::Index j = of_target; j < first; ++j)
    result.row(j) += P.column(j).template segment<K>(first - j).transpose().lazyProduct(Ht);
  result.template middleRows<K>(first) += P.square<K>(first) * Ht;
  for (Eigen::Index j = first; j < after; ++j) {
    const auto column = P.column(j).tail(below);
    result.col(0).tail(below) += column * Ht(j - first, 0);
    result.col(1).tail(below) += column * Ht(j - first, 1);
  }
}

// P - G G^T in the first columns; the others stay as they are.
void subtract_square(const FilterMatrix2& G, Eigen::Index columns, FilterCovariance& P);

// Propagates the target by a motion.
void propagate(const Transition& motion, FilterGaussian& state);

// Each state times its own factor.
void scale(const FilterVector& factors, FilterGaussian& state);

// Inserts zero states before the given one, or at the end.
void insert_states(Eigen::Index before, Eigen::Index more, FilterGaussian& state);

// Of a mixture with these weights: mean and covariance of the first states.
WholeGaussian mixture(std::span<const FilterGaussian> parts, std::span<const double> weights,
                      Eigen::Index states);

// Each becomes a mixture of all, with its own weights (Blom and Bar-Shalom's interaction).
using MixtureWeights = std::array<double, kMotions>;
void interact(const std::array<MixtureWeights, kMotions>& weights, std::span<FilterGaussian> parts);

}  // namespace ols::fusion
