// The bootstrap particle filter's bookkeeping: weights, maximum a posteriori, resampling.
#pragma once

#include <utility>
#include <vector>

#include "edge/tracker/motion_model.h"

namespace ols::tracker {

class ParticleFilter {
 public:
  std::vector<Particle>& particles() { return particles_; }
  const std::vector<Particle>& particles() const { return particles_; }

  // Advances every particle to this frame, without noise.
  void advance(const MotionModel& motion);
  // Adds the motion model's noise to particles already advanced to this frame, and remembers their
  // predictions without it.
  void disturb(const MotionModel& motion, Random& random);
  // Restarts around a target that was found otherwise; the next disturb() spreads the particles.
  void restart(const Particle& target);
  // A new target is either stationary relative to the scene, or was followed by the camera and is
  // stationary in the image.
  void guess_velocities(const MotionModel& motion, double sd_px_s, Random& random);
  // An approaching target grows faster than the particles' noise, so some particles get its usual
  // size.
  void propose_size(const Eigen::Vector2d& present_px, const Eigen::Vector2d& usual_px);
  // Adds this standard deviation to the prediction's uncertainty beyond that of its particles.
  void widen_prediction(double sd_px) {
    predicted_covariance_px2_ += sd_px * sd_px * Eigen::Matrix2d::Identity();
  }

  // Moves every second particle by this additional step.
  void move_half(const Eigen::Vector2d& step_px);

  // Weights from each particle's log-likelihood; all equal if none is finite.
  template <typename LogLikelihood>
  void weigh(const LogLikelihood& log_likelihood_of) {
    log_likelihood_.clear();
    for (const Particle& particle : particles_) {
      log_likelihood_.push_back(log_likelihood_of(particle));
    }
    weigh_by_log_likelihood();
  }
  const std::vector<double>& log_likelihood() const { return log_likelihood_; }
  // The weights must sum to one.
  void set_weights(std::vector<double> weights) { weights_ = std::move(weights); }
  const std::vector<double>& weights() const { return weights_; }

  // Index of the maximum a posteriori: likelihood times the predicted density at the particle. The
  // density distinguishes the target from a similar object elsewhere.
  std::size_t maximum_a_posteriori() const;

  Eigen::Vector2d mean_size_px() const;
  Eigen::Vector2d mean_velocity_px_s() const;
  // Of the particles' positions about `pixel`.
  Eigen::Matrix2d covariance_about(const Eigen::Vector2d& pixel) const;

  // Systematic resampling.
  void resample(Random& random);

 private:
  void weigh_by_log_likelihood();

  std::vector<Particle> particles_;
  std::vector<Particle> resampled_;  // reused: no allocation in steady state
  std::vector<double> log_likelihood_;
  std::vector<double> weights_;
  Eigen::Vector2d predicted_mean_px_ = Eigen::Vector2d::Zero();
  Eigen::Matrix2d predicted_covariance_px2_ = Eigen::Matrix2d::Identity();
};

}  // namespace ols::tracker
