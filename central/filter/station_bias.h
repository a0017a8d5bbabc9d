// Extracts from a filter's state each station's bias, and the systematic part of the position's
// covariance. Pure.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "central/filter/bias_model.h"
#include "central/filter/filter_gaussian.h"
#include "central/filter/interacting_models.h"

namespace ols::fusion {

inline Eigen::Index states_of(const BiasPrior& prior) {
  return prior.position_states ? kStationStates : kPoseStates;
}

// The systematic part of the position's covariance at the state's own instant. all_m2: from all
// biases. empirical_m2: from the undeclared biases, which only residuals show.
struct SystematicPart {
  Eigen::Matrix3d all_m2 = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d empirical_m2 = Eigen::Matrix3d::Zero();
};

// P: covariance of a whole state. Its order is position, velocity, acceleration, then
// states_of(prior) states for each station.
SystematicPart systematic_part(const Eigen::Ref<const Eigen::MatrixXd>& P,
                               const std::vector<BiasPrior>& priors);

struct StationBias {
  Eigen::Vector2d bias_rad = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance_rad2 = Eigen::Matrix2d::Zero();
  Eigen::Matrix2d prior_rad2 = Eigen::Matrix2d::Zero();
  double clock_s = 0.0;
  double clock_sd_s = 0.0;
  double clock_prior_sd_s = 0.0;
};

// A station's bias in the direction of its last bearing, as the mean over the models. `first`:
// index of the station's first state. `sight`: the last bearing.
StationBias station_bias(const InteractingModels& models, Eigen::Index first,
                         const BiasPrior& prior, const LineOfSight& sight, double range_m);

}  // namespace ols::fusion
