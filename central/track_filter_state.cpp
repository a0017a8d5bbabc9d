// What a filter's state tells: mixed over its models, at any instant, with its parts.
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "central/time_span.h"
#include "central/track_filter.h"

namespace ols {

void TrackFilter::refresh() {
  summary_.utime_us = utime_us_;
  summary_.mean.setZero();
  summary_.covariance.setZero();
  for (const Model& model : models_) {
    summary_.mean += model.probability * model.mean.head<9>();
    summary_.covariance += model.probability * model.covariance.topLeftCorner<9, 9>();
  }
  for (const Model& model : models_) {
    const Vector9 off = model.mean.head<9>() - summary_.mean;
    summary_.covariance += model.probability * off * off.transpose();
  }
}

void TrackFilter::mixed(FilterVector& mean, FilterMatrix& covariance) const {
  const Eigen::Index n = models_[0].mean.size();
  mean = FilterVector::Zero(n);
  covariance = FilterMatrix::Zero(n, n);
  for (const Model& model : models_) mean += model.probability * model.mean;
  for (const Model& model : models_) {
    const FilterVector off = model.mean - mean;
    covariance += model.probability * model.covariance;
    covariance.noalias() += (model.probability * off) * off.transpose();
  }
}

KinematicState TrackFilter::at(std::int64_t utime_us) const {
  const double dt_s = seconds(utime_us - utime_us_);
  KinematicState state;
  state.utime_us = utime_us;
  std::array<Vector9, kMotions> means;
  std::array<Matrix9, kMotions> covariances;
  for (std::size_t m = 0; m < models_.size(); ++m) {
    means[m] = models_[m].mean.head<9>();
    covariances[m] = models_[m].covariance.topLeftCorner<9, 9>();
    Transition t = transition(static_cast<Motion>(m), means[m], std::abs(dt_s), config_.motion);
    if (dt_s < 0.0) t.f << 1.0, dt_s, dt_s * dt_s / 2.0, 0.0, 1.0, dt_s, 0.0, 0.0, 1.0;
    transform_rows(t.f, means[m]);
    propagate_covariance(t, covariances[m]);
    state.mean += models_[m].probability * means[m];
  }
  for (std::size_t m = 0; m < models_.size(); ++m) {
    const Vector9 off = means[m] - state.mean;
    state.covariance += models_[m].probability * (covariances[m] + off * off.transpose());
  }
  return state;
}

SystematicPart TrackFilter::systematic() const {
  FilterVector mean;
  FilterMatrix P;
  mixed(mean, P);
  return systematic_part(P, priors_);
}

SystematicPart systematic_part(const Eigen::Ref<const Eigen::MatrixXd>& P,
                               const std::vector<BiasPrior>& priors) {
  const Eigen::Index biases = P.rows() - 9;
  if (biases == 0) return {};
  Eigen::MatrixXd own = P.bottomRightCorner(biases, biases);
  own.diagonal().array() += 1e-18;  // a clock that is known has no variance
  const auto cross = P.topRightCorner(3, biases);
  // What each bias moves the position by.
  Eigen::Matrix<double, 3, Eigen::Dynamic> moves = own.ldlt().solve(cross.transpose()).transpose();
  SystematicPart part;
  part.all_m2 = moves * own * moves.transpose();
  Eigen::Index at = 0;
  for (const BiasPrior& prior : priors) {
    moves.middleCols<3>(at) *= prior.shown.matrix().asDiagonal();
    moves.middleCols(at + 3, states_of(prior) - 3).setZero();
    at += states_of(prior);
  }
  part.shown_m2 = moves * own * moves.transpose();
  return part;
}

StationBias TrackFilter::bias(std::size_t station) const {
  const BiasPrior& prior = priors_[station];
  const SightLine& sight = stations_[station].sight;
  const Eigen::Index at = first_of(static_cast<int>(station)), n = states_of(prior);
  StationVector mean = StationVector::Zero(n);
  for (const Model& model : models_) mean += model.probability * model.mean.segment(at, n);
  StationMatrix P = StationMatrix::Zero(n, n);
  for (const Model& model : models_) {
    const StationVector off = model.mean.segment(at, n) - mean;
    P += model.probability * (model.covariance.block(at, at, n, n) + off * off.transpose());
  }
  const Eigen::Matrix<double, 3, 2> tangent = tangent_basis(sight.direction);
  Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, kPoseStates + kPlaceStates> B(2, n);
  B.setZero();
  B.leftCols<3>() = bias_by_rotation(tangent);
  if (prior.place_apart) {
    const double range_m = (position() - sight.origin_ecef).norm();
    B.rightCols<kPlaceStates>() = -tangent.transpose() / range_m;
  }
  StationBias result;
  result.bias_rad = B * mean;
  result.covariance_rad2 = B * P * B.transpose();
  result.prior_rad2 = prior.covariance;
  result.clock_s = mean(3);
  result.clock_sd_s = std::sqrt(std::max(0.0, P(3, 3)));
  result.clock_prior_sd_s = stations_[station].clock_sd_s;
  return result;
}

std::array<double, kMotions> TrackFilter::probabilities() const {
  std::array<double, kMotions> result{};
  for (std::size_t m = 0; m < models_.size(); ++m) result[m] = models_[m].probability;
  return result;
}

}  // namespace ols
