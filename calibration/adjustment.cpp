#include "calibration/adjustment.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace ols::calibration {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kHeadingScale_rad = 1e-3;
// The heading is unknown, which needs a number, too: the weight of a turn either way.
constexpr double kAnyHeading_rad = 3.0;

VectorXd scale_of(const Network& network) {
  const Layout& layout = network.layout;
  VectorXd scale = VectorXd::Zero(layout.size());
  for (std::size_t s = 0; s < layout.stations; ++s) {
    const StationPrior& prior = network.stations[s];
    scale.segment<kStationParameters>(layout.station(s)) = prior.covariance.diagonal().cwiseSqrt();
    scale[layout.station(s) + kHeading] = kHeadingScale_rad;
  }
  scale[layout.ut1()] = 0.1;
  for (std::size_t p = 0; p < layout.poses; ++p) {
    scale.segment<2>(layout.pose(p)).setConstant(1e-5);
  }
  return scale;
}

}  // namespace

StationState station_at(const StationPrior& prior, const StationVector& change) {
  StationState state;
  state.model = changed(prior.model, change.head<kModelParameters>());
  state.refraction = prior.refraction + change[kRefraction];
  state.air = prior.air + change[kAir];
  state.change = change;
  return state;
}

Adjustment::Adjustment(Network network)
    : network_(std::move(network)), scale_(scale_of(network_)) {}

State Adjustment::start(const std::vector<double>& headings_rad) const {
  State state;
  for (std::size_t s = 0; s < network_.stations.size(); ++s) {
    StationVector change = StationVector::Zero();
    change[kHeading] = headings_rad[s] - network_.stations[s].model.geometry.chain.heading_rad;
    state.stations.push_back(station_at(network_.stations[s], change));
  }
  state.poses.assign(network_.layout.poses, Eigen::Vector2d::Zero());
  for (const BlockPtr& block : network_.blocks) state.nuisances.push_back(block->initial(state));
  return state;
}

std::vector<bool> Adjustment::used_blocks(const std::vector<bool>& kept) const {
  std::vector<bool> used(network_.blocks.size(), false);
  for (std::size_t b = network_.priors_from; b < used.size(); ++b) used[b] = true;
  for (std::size_t g = 0; g < kept.size(); ++g) {
    for (const std::size_t b : network_.groups[g].blocks) used[b] = kept[g];
  }
  return used;
}

Adjustment::Normal Adjustment::normal(const State& state, const std::vector<bool>& used,
                                      double damping) const {
  const Index size = network_.layout.size();
  Normal result;
  result.N = MatrixXd::Zero(size, size);
  result.b = VectorXd::Zero(size);
  result.equations.resize(network_.blocks.size());
  for (std::size_t i = 0; i < network_.blocks.size(); ++i) {
    if (!used[i]) continue;
    const BlockEquations& one = result.equations[i] =
        network_.blocks[i]->equations(state, i, damping);
    result.valid = result.valid && one.valid;
    if (!result.valid) return result;
    result.misfit += one.misfit;
    for (std::size_t k = 0; k < one.columns.size(); ++k) {
      const int row = one.columns[k];
      result.b[row] += scale_[row] * one.gradient[static_cast<Index>(k)];
      for (std::size_t l = 0; l < one.columns.size(); ++l) {
        const int column = one.columns[l];
        result.N(row, column) += scale_[row] * scale_[column] *
                                 one.information(static_cast<Index>(k), static_cast<Index>(l));
      }
    }
  }
  for (Index k = 0; k < size; ++k) {
    if (scale_[k] == 0.0) result.N(k, k) = 1.0;
  }
  for (std::size_t s = 0; s < network_.stations.size(); ++s) {
    const Index heading = network_.layout.station(s) + kHeading;
    result.N(heading, heading) += std::pow(kHeadingScale_rad / kAnyHeading_rad, 2);
  }
  return result;
}

State Adjustment::stepped(const State& state, const Normal& normal, const std::vector<bool>& used,
                          const VectorXd& step) const {
  const Layout& layout = network_.layout;
  const VectorXd dx = scale_.cwiseProduct(step);
  State next = state;
  for (std::size_t s = 0; s < layout.stations; ++s) {
    const StationVector change =
        state.stations[s].change + StationVector(dx.segment<kStationParameters>(layout.station(s)));
    next.stations[s] = station_at(network_.stations[s], change);
  }
  next.ut1_s += dx[layout.ut1()];
  for (std::size_t p = 0; p < layout.poses; ++p) next.poses[p] += dx.segment<2>(layout.pose(p));
  for (std::size_t i = 0; i < network_.blocks.size(); ++i) {
    const BlockEquations& one = normal.equations[i];
    if (!used[i] || one.nuisance_step.size() == 0) continue;
    VectorXd by(one.columns.size());
    for (Index k = 0; k < by.size(); ++k) by[k] = dx[one.columns[static_cast<std::size_t>(k)]];
    next.nuisances[i] -= one.nuisance_step + one.nuisance_by * by;
  }
  return next;
}

Fit Adjustment::fit(State start, const std::vector<bool>& kept) const {
  // Robust weights make it slow: each step moves the limit of what they hold back.
  constexpr int kIterations = 300;
  constexpr double kStill = 1e-5, kMostDamping = 1e12;
  Fit result;
  result.kept = kept;
  result.state = std::move(start);
  const std::vector<bool> used = used_blocks(kept);
  double damping = 0.0;
  Normal here = normal(result.state, used, damping);
  for (int i = 0; i < kIterations && here.valid && damping < kMostDamping; ++i) {
    MatrixXd damped = here.N;
    damped.diagonal() *= 1.0 + damping;
    const VectorXd step = -damped.ldlt().solve(here.b);
    const State next = stepped(result.state, here, used, step);
    Normal there = normal(next, used, 0.0);
    const bool better = there.valid && there.misfit <= here.misfit + 1e-6 * (1.0 + here.misfit);
    if (!better) {
      damping = damping == 0.0 ? 1e-4 : 10.0 * damping;
      here = normal(result.state, used, damping);
      continue;
    }
    const double gain = here.misfit - there.misfit;
    damping = damping < 1e-6 ? 0.0 : 0.1 * damping;
    result.state = next;
    here = damping == 0.0 ? std::move(there) : normal(next, used, damping);
    if (step.lpNorm<Eigen::Infinity>() < 1e-2 && gain < kStill) {
      result.converged = true;
      break;
    }
  }
  here = normal(result.state, used, 0.0);
  result.misfit = here.valid ? here.misfit : std::numeric_limits<double>::infinity();
  result.equations = std::move(here.equations);
  const VectorXd ones = VectorXd::Ones(scale_.size());
  result.covariance = scale_.asDiagonal() *
                      here.N.ldlt().solve(MatrixXd::Identity(ones.size(), ones.size())) *
                      scale_.asDiagonal();
  fit_rejected(result, used);
  return result;
}

StationMatrix Adjustment::planned_covariance(std::size_t station) const {
  std::vector<double> headings_rad;
  for (const StationPrior& prior : network_.stations) {
    headings_rad.push_back(prior.model.geometry.chain.heading_rad);
  }
  const std::vector<bool> used(network_.blocks.size(), true);
  const Normal there = normal(start(headings_rad), used, 0.0);
  if (!there.valid) return StationMatrix::Constant(std::numeric_limits<double>::infinity());
  const Index first = network_.layout.station(station);
  const MatrixXd unit =
      MatrixXd::Identity(there.N.rows(), there.N.cols()).middleCols(first, kStationParameters);
  const VectorXd scale = scale_.segment(first, kStationParameters);
  return scale.asDiagonal() * there.N.ldlt().solve(unit).middleRows(first, kStationParameters) *
         scale.asDiagonal();
}

// A rejected group's nuisance follows the kept ones: a few steps of its own.
void Adjustment::fit_rejected(Fit& fit, const std::vector<bool>& used) const {
  constexpr int kSteps = 5;
  for (std::size_t i = 0; i < network_.blocks.size(); ++i) {
    if (used[i]) continue;
    for (int k = 0; k < kSteps; ++k) {
      fit.equations[i] = network_.blocks[i]->equations(fit.state, i, 0.0);
      if (!fit.equations[i].valid || fit.equations[i].nuisance_step.size() == 0) break;
      if (k + 1 < kSteps) fit.state.nuisances[i] -= fit.equations[i].nuisance_step;
    }
  }
}

BlockEquations Adjustment::equations(const Fit& fit, std::size_t group) const {
  const std::vector<std::size_t>& blocks = network_.groups[group].blocks;
  if (blocks.size() == 1) return fit.equations[blocks.front()];
  BlockEquations sum;
  for (const std::size_t b : blocks) {
    for (const int column : fit.equations[b].columns) {
      if (std::ranges::find(sum.columns, column) == sum.columns.end())
        sum.columns.push_back(column);
    }
  }
  const auto size = static_cast<Index>(sum.columns.size());
  sum.information = MatrixXd::Zero(size, size);
  sum.gradient = VectorXd::Zero(size);
  sum.shift_by = MatrixXd::Zero(size, 2);
  for (const std::size_t b : blocks) {
    const BlockEquations& one = fit.equations[b];
    sum.valid = sum.valid && one.valid;
    if (!one.valid) continue;
    sum.squares += one.squares;
    sum.misfit += one.misfit;
    sum.shift_information += one.shift_information;
    sum.shift_gradient += one.shift_gradient;
    sum.residuals.insert(sum.residuals.end(), one.residuals.begin(), one.residuals.end());
    sum.weights.insert(sum.weights.end(), one.weights.begin(), one.weights.end());
    std::vector<Index> at;
    for (const int column : one.columns) {
      at.push_back(std::ranges::find(sum.columns, column) - sum.columns.begin());
    }
    for (Index k = 0; k < one.gradient.size(); ++k) {
      const Index row = at[static_cast<std::size_t>(k)];
      sum.gradient[row] += one.gradient[k];
      if (one.shift_by.rows() > 0) sum.shift_by.row(row) += one.shift_by.row(k);
      for (Index l = 0; l < one.gradient.size(); ++l) {
        sum.information(row, at[static_cast<std::size_t>(l)]) += one.information(k, l);
      }
    }
  }
  return sum;
}

}  // namespace ols::calibration
