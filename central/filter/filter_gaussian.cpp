#include "central/filter/filter_gaussian.h"

#include <vector>

namespace ols::fusion {
namespace {

// One column or the mean: position, velocity and acceleration of an axis are three rows apart.
template <class Vector>
void propagate_rows(const Eigen::Matrix3d& f, Vector&& state) {
  const Eigen::Vector3d v = state.template segment<3>(3), a = state.template segment<3>(6);
  state.template head<3>() += f(0, 1) * v + f(0, 2) * a;
  state.template segment<3>(3) = f(1, 1) * v + f(1, 2) * a;
  state.template segment<3>(6) = f(2, 1) * v + f(2, 2) * a;
}

void propagate_columns(const Eigen::Matrix3d& f, FilterMatrix& P) {
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    auto p = P.col(axis), v = P.col(3 + axis), a = P.col(6 + axis);
    const FilterVector before = v;
    p += f(0, 1) * v + f(0, 2) * a;
    v = f(1, 1) * v + f(1, 2) * a;
    a = f(2, 1) * before + f(2, 2) * a;
  }
}

// A mixture's mean, and the deviations of its components' means.
struct Mixture {
  Mixture(std::span<const FilterGaussian> parts, std::span<const double> of_each,
          Eigen::Index states)
      : weights(of_each), mean(FilterVector::Zero(states)) {
    for (std::size_t i = 0; i < parts.size(); ++i) mean += weights[i] * parts[i].mean.head(states);
    for (std::size_t i = 0; i < parts.size(); ++i) off[i] = parts[i].mean.head(states) - mean;
  }

  // That many rows of its covariance, from the diagonal on.
  void column(Eigen::Index j, Eigen::Index n, std::span<const FilterGaussian> parts,
              FilterVector& result) const {
    const auto of = [&](std::size_t i) {
      return weights[i] * parts[i].covariance.col(j).segment(j, n) +
             (weights[i] * off[i](j)) * off[i].segment(j, n);
    };
    result = of(0);
    for (std::size_t i = 1; i < parts.size(); ++i) result += of(i);
  }

  std::span<const double> weights;
  FilterVector mean;
  std::array<FilterVector, kMotions> off;
};

}  // namespace

void subtract_square(const FilterMatrix2& G, Eigen::Index columns, FilterMatrix& P) {
  for (Eigen::Index j = 0; j < columns; ++j) {
    const Eigen::Index n = P.rows() - j;
    P.col(j).tail(n) -= G(j, 0) * G.col(0).tail(n) + G(j, 1) * G.col(1).tail(n);
  }
}

// P' = F P F^T + Q: the columns of all correlated states, then the target's own rows.
void propagate(const Transition& motion, FilterGaussian& state) {
  FilterMatrix& P = state.covariance;
  auto own = P.topLeftCorner<9, 9>();
  own.triangularView<Eigen::StrictlyUpper>() = own.transpose();
  propagate_rows(motion.f, state.mean);
  propagate_columns(motion.f, P);
  for (Eigen::Index j = 0; j < 9; ++j) propagate_rows(motion.f, P.col(j));
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j <= i; ++j) {
      P.block<3, 3>(3 * i, 3 * j) += motion.q(i, j) * motion.directions;
    }
  }
}

void scale(const FilterVector& factors, FilterGaussian& state) {
  state.mean.array() *= factors.array();
  for (Eigen::Index j = 0; j < factors.size(); ++j) {
    const Eigen::Index n = factors.size() - j;
    state.covariance.col(j).tail(n).array() *= factors(j) * factors.tail(n).array();
  }
}

void insert_states(Eigen::Index before, Eigen::Index more, FilterGaussian& state) {
  const FilterGaussian was = state;
  const Eigen::Index n = was.mean.size(), rest = n - before;
  state.mean = FilterVector::Zero(n + more);
  state.mean.head(before) = was.mean.head(before);
  state.mean.tail(rest) = was.mean.tail(rest);
  state.covariance = FilterMatrix::Zero(n + more, n + more);
  state.covariance.topLeftCorner(before, before) = was.covariance.topLeftCorner(before, before);
  state.covariance.bottomLeftCorner(rest, before) = was.covariance.bottomLeftCorner(rest, before);
  state.covariance.bottomRightCorner(rest, rest) = was.covariance.bottomRightCorner(rest, rest);
}

FilterGaussian mixture(std::span<const FilterGaussian> parts, std::span<const double> weights,
                       Eigen::Index states) {
  if (parts.size() == 1) {
    FilterGaussian one{parts[0].mean.head(states),
                       parts[0].covariance.topLeftCorner(states, states)};
    one.covariance.triangularView<Eigen::StrictlyUpper>() = one.covariance.transpose();
    return one;
  }
  const Mixture all(parts, weights, states);
  FilterGaussian result{all.mean, FilterMatrix(states, states)};
  FilterVector column;
  for (Eigen::Index j = 0; j < states; ++j) {
    all.column(j, states - j, parts, column);
    result.covariance.col(j).tail(states - j) = column;
    result.covariance.row(j).tail(states - j) = column.transpose();
  }
  return result;
}

void interact(const std::array<MixtureWeights, kMotions>& weights,
              std::span<FilterGaussian> parts) {
  const Eigen::Index n = parts[0].mean.size();
  std::vector<Mixture> mixtures;
  for (std::size_t to = 0; to < parts.size(); ++to) mixtures.emplace_back(parts, weights[to], n);
  std::array<FilterVector, kMotions> columns;
  for (Eigen::Index j = 0; j < n; ++j) {
    for (std::size_t to = 0; to < parts.size(); ++to) {
      mixtures[to].column(j, n - j, parts, columns[to]);
    }
    for (std::size_t to = 0; to < parts.size(); ++to) {
      parts[to].covariance.col(j).tail(n - j) = columns[to];
    }
  }
  for (std::size_t to = 0; to < parts.size(); ++to) parts[to].mean = mixtures[to].mean;
}

}  // namespace ols::fusion
