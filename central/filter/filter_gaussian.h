// The mean and the covariance of a filter's state, and the operations on them for every bearing.
// Pure.
//
// The target's nine states (motion_model.h) come first, then those of the stations. Only the lower
// triangle of the covariance is stored: this halves the work, and the matrix cannot become
// asymmetric. To save memory traffic, each function passes through the columns only once.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <utility>

#include "central/filter/motion_model.h"

namespace ols::fusion {

inline constexpr int kFilterStations = 12;  // largest number of stations with states of their own
// The states of a station: its rotation about east, north and up, its clock's offset, and the
// elevation error that is fixed in its camera. If the errors of the station's position and aim
// matter at the target's range, there are three more states: the sum of these two errors (east,
// north, up).
inline constexpr int kPoseStates = 5, kPlaceStates = 3;
inline constexpr int kClockState = 3, kCameraState = 4;
inline constexpr int kStationStates = kPoseStates + kPlaceStates;
inline constexpr int kFilterStates = 9 + kStationStates * kFilterStations;

using FilterVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kFilterStates, 1>;
// The matrices are on the heap, with their actual size: thousands of filters are copied and kept. A
// matrix takes 70 kB with the maximum number of states, and a tenth of that with a few stations.
using FilterMatrix = Eigen::MatrixXd;
using FilterMatrix2 = Eigen::Matrix<double, Eigen::Dynamic, 2, 0, kFilterStates, 2>;

struct FilterGaussian {
  FilterVector mean;
  FilterMatrix covariance;  // lower triangle
};

// The target's states alone.
struct TargetGaussian {
  Vector9 mean;
  Matrix9 covariance;  // lower triangle
};

// A square block on the diagonal of P, with both triangles filled.
template <int K>
Eigen::Matrix<double, K, K> whole_block(const FilterMatrix& P, Eigen::Index first) {
  return P.block<K, K>(first, first).template selfadjointView<Eigen::Lower>();
}

// Adds P H^T to `result`. H (2 x states) consists of the given columns from `first` on, and is zero
// elsewhere.
template <int K>
void add_product(const FilterMatrix& P, Eigen::Index first, const Eigen::Matrix<double, 2, K>& H,
                 FilterMatrix2& result) {
  const Eigen::Matrix<double, K, 2> Ht = H.transpose();
  const Eigen::Index below = P.rows() - first - K;
  result.topRows(first) += P.block(first, 0, K, first).transpose().lazyProduct(Ht);
  result.middleRows<K>(first) += whole_block<K>(P, first) * Ht;
  result.bottomRows(below) += P.block(first + K, first, below, K).lazyProduct(Ht);
}

// Subtracts G G^T from the first `columns` columns of P.
void subtract_square(const FilterMatrix2& G, Eigen::Index columns, FilterMatrix& P);

void propagate(const Transition& motion, FilterGaussian& state);
void propagate(const Transition& motion, TargetGaussian& state);

// Multiplies each state by its own factor.
void scale(const FilterVector& factors, FilterGaussian& state);

// Inserts `more` zero states before the state with index `before`; at the end if `before` is the
// number of states.
void insert_states(Eigen::Index before, Eigen::Index more, FilterGaussian& state);

// Mean and covariance of a mixture of up to kMotions components with these weights; both triangles
// are filled.
FilterGaussian mixture(std::span<const FilterGaussian> parts, std::span<const double> weights);
// Mean and covariance of the target alone.
TargetGaussian target_mixture(std::span<const FilterGaussian> parts,
                              std::span<const double> weights);
TargetGaussian target_mixture(std::span<const TargetGaussian> parts,
                              std::span<const double> weights);

// Replaces each component by a mixture of all components (the interaction of Blom and Bar-Shalom).
// weights[i]: the weights of the mixture that replaces component i.
using MixtureWeights = std::array<double, kMotions>;
void interact(const std::array<MixtureWeights, kMotions>& weights, std::span<FilterGaussian> parts);

}  // namespace ols::fusion
