#include "central/filter/filter_gaussian.h"

#include <algorithm>
#include <vector>

#include "central/filter/columns.h"

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

// P' = F P F^T + Q: the columns of all correlated states, then the target's own rows.
template <class Gaussian>
void propagate_any(const Transition& motion, Gaussian& state) {
  auto& P = state.covariance;
  auto own = P.template topLeftCorner<9, 9>();
  own.template triangularView<Eigen::StrictlyUpper>() = own.transpose();
  propagate_rows(motion.f, state.mean);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    columns::propagate(motion.f, P.rows(), {&P(0, axis), &P(0, 3 + axis), &P(0, 6 + axis)});
  }
  for (Eigen::Index j = 0; j < 9; ++j) propagate_rows(motion.f, own.col(j));
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j <= i; ++j) {
      own.template block<3, 3>(3 * i, 3 * j) += motion.q(i, j) * motion.directions;
    }
  }
}

// A mixture's mean, and the deviations of its components' means.
template <class Gaussian, class Vector>
class Mixture {
 public:
  Mixture(std::span<const Gaussian> parts, std::span<const double> weights, Eigen::Index states)
      : mean(Vector::Zero(states)), parts_(parts), weights_(weights) {
    for (std::size_t i = 0; i < parts.size(); ++i) mean += weights[i] * parts[i].mean.head(states);
    for (std::size_t i = 0; i < parts.size(); ++i) off_[i] = parts[i].mean.head(states) - mean;
  }

  // Its covariance in this column, from the diagonal on.
  void column(Eigen::Index j, double* result) const {
    columns::Parts parts;  // those that there are not have no weight
    for (std::size_t i = 0; i < kMotions; ++i) {
      const bool is_there = i < parts_.size();
      const std::size_t from = is_there ? i : 0;
      const double weight = is_there ? weights_[i] : 0.0;
      parts[i] = {&parts_[from].covariance(j, j), &off_[from](j), weight, weight * off_[from](j)};
    }
    columns::mix(parts, mean.size() - j, result);
  }

  Vector mean;

 private:
  std::span<const Gaussian> parts_;
  std::span<const double> weights_;
  std::array<Vector, kMotions> off_;
};

template <class Gaussian>
TargetGaussian target_mixture_of_any(std::span<const Gaussian> parts,
                                     std::span<const double> weights) {
  const Mixture<Gaussian, Vector9> all(parts, weights, 9);
  TargetGaussian result{all.mean, {}};
  for (Eigen::Index j = 0; j < 9; ++j) all.column(j, &result.covariance(j, j));
  result.covariance.triangularView<Eigen::StrictlyUpper>() = result.covariance.transpose();
  return result;
}

}  // namespace

void subtract_square(const FilterMatrix2& G, Eigen::Index columns, FilterMatrix& P) {
  columns::subtract_square(G.col(0).data(), G.col(1).data(), columns, P.rows(), P.data());
}

void propagate(const Transition& motion, FilterGaussian& state) { propagate_any(motion, state); }
void propagate(const Transition& motion, TargetGaussian& state) { propagate_any(motion, state); }

void scale(const FilterVector& factors, FilterGaussian& state) {
  state.mean.array() *= factors.array();
  columns::scale(factors.data(), factors.size(), state.covariance.data());
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

FilterGaussian mixture(std::span<const FilterGaussian> parts, std::span<const double> weights) {
  const Eigen::Index n = parts[0].mean.size();
  const Mixture<FilterGaussian, FilterVector> all(parts, weights, n);
  FilterGaussian result{all.mean, FilterMatrix(n, n)};
  for (Eigen::Index j = 0; j < n; ++j) {
    all.column(j, &result.covariance(j, j));
    result.covariance.row(j).tail(n - j) = result.covariance.col(j).tail(n - j).transpose();
  }
  return result;
}

TargetGaussian target_mixture(std::span<const FilterGaussian> parts,
                              std::span<const double> weights) {
  return target_mixture_of_any(parts, weights);
}

TargetGaussian target_mixture(std::span<const TargetGaussian> parts,
                              std::span<const double> weights) {
  return target_mixture_of_any(parts, weights);
}

void interact(const std::array<MixtureWeights, kMotions>& weights,
              std::span<FilterGaussian> parts) {
  const Eigen::Index n = parts[0].mean.size();
  const std::span<const FilterGaussian> before = parts;
  std::vector<Mixture<FilterGaussian, FilterVector>> mixtures;
  for (std::size_t to = 0; to < parts.size(); ++to) mixtures.emplace_back(before, weights[to], n);
  std::array<std::array<double, kFilterStates>, kMotions> mixed;
  for (Eigen::Index j = 0; j < n; ++j) {
    for (std::size_t to = 0; to < parts.size(); ++to) mixtures[to].column(j, mixed[to].data());
    for (std::size_t to = 0; to < parts.size(); ++to) {
      std::copy_n(mixed[to].data(), n - j, &parts[to].covariance(j, j));
    }
  }
  for (std::size_t to = 0; to < parts.size(); ++to) parts[to].mean = mixtures[to].mean;
}

}  // namespace ols::fusion
