// A mixture of Gaussians, one for each motion model, over the same state (IMM: Blom and Bar-Shalom,
// 1988). Pure.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "central/filter/filter_gaussian.h"
#include "central/filter/motion_model.h"

namespace ols::fusion {

// Position, velocity, acceleration; three components each.
struct KinematicState {
  std::int64_t utime_us = 0;
  Vector9 mean = Vector9::Zero();
  Matrix9 covariance = Matrix9::Zero();
};

// The position at another instant, extrapolated with velocity and acceleration.
Eigen::Vector3d position_at(const KinematicState& state, std::int64_t utime_us);

// Initial position and motion of a target, with large variances.
struct FilterStart {
  Eigen::Vector3d p_ecef = Eigen::Vector3d::Zero();
  Eigen::Vector3d v_ecef = Eigen::Vector3d::Zero();
  double position_sd_m = 0.0;
  double velocity_sd_m_s = 0.0;
};

class InteractingModels {
 public:
  // Throws std::invalid_argument for a configuration without models.
  InteractingModels(const MotionConfig& config, std::int64_t utime_us, const FilterStart& start);

  std::int64_t utime_us() const { return utime_us_; }
  const MotionConfig& config() const { return config_; }
  Motion motion(std::size_t model) const { return config_.models[model]; }
  std::size_t size() const { return models_.size(); }
  const FilterGaussian& operator[](std::size_t model) const { return models_[model]; }
  std::vector<FilterGaussian>& each() { return models_; }
  const std::vector<double>& probabilities() const { return probabilities_; }

  // Predicts each model separately. utime_us must not be before the state's own instant.
  void predict(std::int64_t utime_us);
  // Mixes the models, dt_s after the last mixing.
  void interact(double dt_s);
  // Updates the models' probabilities after a measurement, from the log-likelihood of each model.
  void weigh(std::span<const double> log_likelihood);
  // Inflates the covariance along `along` (a projection matrix), by the effect of the largest
  // likely acceleration at this velocity over time_s.
  void inflate(double time_s, const Eigen::Matrix3d& along, const Eigen::Vector3d& v_ecef);

  // Means and covariances of the mixture: of the kinematics at the state's own instant, of the
  // kinematics at another instant, and of the whole state.
  KinematicState kinematics() const;
  KinematicState at(std::int64_t utime_us) const;
  FilterGaussian mixed() const;

 private:
  MotionConfig config_;
  std::int64_t utime_us_;
  std::vector<FilterGaussian> models_;  // in the order of config_.models
  std::vector<double> probabilities_;
};

}  // namespace ols::fusion
