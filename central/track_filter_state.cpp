// What a filter's state tells: mixed over its models, at any instant, with its parts.
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "central/time_span.h"
#include "central/track_filter.h"

namespace ols {

void TrackFilter::refresh() {
  const FilterGaussian target = mixture(models_, probabilities_, 9);
  summary_ = {utime_us_, target.mean, target.covariance};
}

FilterGaussian TrackFilter::mixed() const {
  return mixture(models_, probabilities_, models_[0].mean.size());
}

KinematicState TrackFilter::at(std::int64_t utime_us) const {
  const double dt_s = seconds(utime_us - utime_us_);
  std::array<FilterGaussian, kMotions> then;
  for (std::size_t m = 0; m < models_.size(); ++m) {
    then[m].mean = models_[m].mean.head<9>();
    then[m].covariance = models_[m].covariance.topLeftCorner<9, 9>();
    const Vector9 now = then[m].mean;
    Transition t = transition(motions()[m], now, std::abs(dt_s), config_.motion);
    if (dt_s < 0.0) t.f << 1.0, dt_s, dt_s * dt_s / 2.0, 0.0, 1.0, dt_s, 0.0, 0.0, 1.0;
    propagate(t, then[m]);
  }
  const FilterGaussian state = mixture(std::span(then).first(models_.size()), probabilities_, 9);
  return {utime_us, state.mean, state.covariance};
}

SystematicPart TrackFilter::systematic() const {
  return systematic_part(mixed().covariance, priors_);
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
  const LineOfSight& sight = stations_[station].sight;
  const Eigen::Index at = first_of(static_cast<int>(station)), n = states_of(prior);
  StationVector mean = StationVector::Zero(n);
  for (std::size_t m = 0; m < models_.size(); ++m) {
    mean += probabilities_[m] * models_[m].mean.segment(at, n);
  }
  StationMatrix P = StationMatrix::Zero(n, n);
  for (std::size_t m = 0; m < models_.size(); ++m) {
    const StationVector off = models_[m].mean.segment(at, n) - mean;
    const StationMatrix own =
        models_[m].covariance.block(at, at, n, n).selfadjointView<Eigen::Lower>();
    P += probabilities_[m] * (own + off * off.transpose());
  }
  const Eigen::Matrix<double, 3, 2> tangent = tangent_basis(sight.direction);
  Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, kStationStates> B(2, n);
  B.setZero();
  B.leftCols<3>() = shift_by_rotation(tangent);
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

}  // namespace ols
