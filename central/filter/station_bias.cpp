#include "central/filter/station_bias.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace ols::fusion {
namespace {

using StationMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kStationStates, kStationStates>;
using StationVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kStationStates, 1>;

}  // namespace

SystematicPart systematic_part(const Eigen::Ref<const Eigen::MatrixXd>& P,
                               const std::vector<BiasPrior>& priors) {
  const Eigen::Index biases = P.rows() - 9;
  if (biases == 0) return {};
  Eigen::MatrixXd own = P.bottomRightCorner(biases, biases);
  own.diagonal().array() += 1e-18;  // a perfect clock has no variance
  const auto cross = P.topRightCorner(3, biases);
  // How much each bias moves the position.
  Eigen::Matrix<double, 3, Eigen::Dynamic> moves = own.ldlt().solve(cross.transpose()).transpose();
  SystematicPart part;
  part.all_m2 = moves * own * moves.transpose();
  Eigen::Index at = 0;
  for (const BiasPrior& prior : priors) {
    moves.middleCols<3>(at) *= prior.empirical.matrix().asDiagonal();
    moves.middleCols(at + 3, states_of(prior) - 3).setZero();
    at += states_of(prior);
  }
  part.empirical_m2 = moves * own * moves.transpose();
  return part;
}

StationBias station_bias(const InteractingModels& models, Eigen::Index first,
                         const BiasPrior& prior, const LineOfSight& sight, double range_m) {
  const Eigen::Index n = states_of(prior);
  StationVector mean = StationVector::Zero(n);
  for (std::size_t m = 0; m < models.size(); ++m) {
    mean += models.probabilities()[m] * models[m].mean.segment(first, n);
  }
  StationMatrix P = StationMatrix::Zero(n, n);
  for (std::size_t m = 0; m < models.size(); ++m) {
    const StationVector off = models[m].mean.segment(first, n) - mean;
    const StationMatrix own =
        models[m].covariance.block(first, first, n, n).selfadjointView<Eigen::Lower>();
    P += models.probabilities()[m] * (own + off * off.transpose());
  }
  const Eigen::Matrix<double, 3, 2> tangent = tangent_basis(sight.direction);
  Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, kStationStates> B(2, n);
  B.setZero();
  B.leftCols<3>() = shift_by_rotation(tangent);
  B(1, kCameraState) = 1.0;
  if (prior.position_states) B.rightCols<kPlaceStates>() = -tangent.transpose() / range_m;
  StationBias result;
  result.bias_rad = B * mean;
  result.covariance_rad2 = B * P * B.transpose();
  result.prior_rad2 = prior.covariance;
  result.clock_s = mean(kClockState);
  result.clock_sd_s = std::sqrt(std::max(0.0, P(kClockState, kClockState)));
  return result;
}

}  // namespace ols::fusion
