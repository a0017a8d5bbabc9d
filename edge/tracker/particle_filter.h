// The bookkeeping of the bootstrap particle filter: weights, maximum a posteriori, resampling.
#pragma once

#include <utility>
#include <vector>

#include "edge/tracker/motion_model.h"

namespace ols::tracker {

class ParticleFilter {
 public:
  std::vector<Particle>& particles() { return particles_; }
  const std::vector<Particle>& particles() const { return particles_; }

  // Moves every particle to this frame, without noise.
  void advance(const MotionModel& motion);
  // Adds the motion model's noise to particles that are already advanced to this frame. Stores mean
  // and covariance of the prediction for maximum_a_posteriori().
  void disturb(const MotionModel& motion, Random& random);
  // Puts all particles on a target that was found by other means; the next disturb() spreads them.
  void restart(const Particle& target);
  // Sets initial velocities. Half of the particles rest relative to the scene. The others rest in
  // the image, because the camera may have followed the target.
  void guess_velocities(const MotionModel& motion, double sd_px_s, Random& random);
  // Gives some particles the target's usual size, because an approaching target grows faster than
  // the particles' noise allows.
  void propose_size(const Eigen::Vector2d& present_px, const Eigen::Vector2d& usual_px);
  // Adds this standard deviation, in quadrature, to the uncertainty of the predicted position.
  void widen_prediction(double sd_px) {
    predicted_covariance_px2_ += sd_px * sd_px * Eigen::Matrix2d::Identity();
  }

  // Moves every second particle by this step.
  void move_half(const Eigen::Vector2d& step_px);

  // Computes the weights from each particle's log-likelihood; they are equal if none is finite.
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

  // Index of the maximum a posteriori: the particle with the greatest product of its likelihood and
  // the predicted density at its position. The density distinguishes the target from a similar
  // object elsewhere.
  std::size_t maximum_a_posteriori() const;

  Eigen::Vector2d mean_size_px() const;
  Eigen::Vector2d mean_velocity_px_s() const;
  // Covariance of the particles' positions about `pixel`.
  Eigen::Matrix2d covariance_about(const Eigen::Vector2d& pixel) const;

  // Resamples systematically.
  void resample(Random& random);

 private:
  void weigh_by_log_likelihood();

  std::vector<Particle> particles_;
  std::vector<Particle> resampled_;  // kept to avoid allocations
  std::vector<double> log_likelihood_;
  std::vector<double> weights_;
  Eigen::Vector2d predicted_mean_px_ = Eigen::Vector2d::Zero();
  Eigen::Matrix2d predicted_covariance_px2_ = Eigen::Matrix2d::Identity();
};

}  // namespace ols::tracker
