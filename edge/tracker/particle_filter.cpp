#include "edge/tracker/particle_filter.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace ols::tracker {
namespace {

// Density of "anywhere" relative to the prediction's peak: a target that did not follow the motion
// model is still found if nothing nearer is similar.
constexpr double kAnywhere = 1e-4;

}  // namespace

void ParticleFilter::restart(const Particle& target) {
  particles_.assign(particles_.size(), target);
  weights_.assign(particles_.size(), 1.0 / static_cast<double>(particles_.size()));
}

void ParticleFilter::guess_velocities(const MotionModel& motion, double sd_px_s, Random& random) {
  bool with_camera = false;
  for (Particle& particle : particles_) {
    particle.velocity_px_s = with_camera ? motion.image_fixed_velocity() : Eigen::Vector2d::Zero();
    particle.velocity_px_s.x() += sd_px_s * random.gaussian();
    particle.velocity_px_s.y() += sd_px_s * random.gaussian();
    with_camera = !with_camera;
  }
}

// Evenly among the resampled ones, which are in the order of their ancestors.
void ParticleFilter::propose_size(const Eigen::Vector2d& present_px,
                                  const Eigen::Vector2d& usual_px) {
  constexpr std::size_t kEvery = 8;
  constexpr double kOff = 0.15;
  const Eigen::Vector2d off = usual_px.cwiseQuotient(present_px).array().log();
  if (off.cwiseAbs().maxCoeff() < kOff) return;
  for (std::size_t i = 0; i < particles_.size(); i += kEvery) particles_[i].size_px = usual_px;
}

void ParticleFilter::advance(const MotionModel& motion) {
  for (Particle& particle : particles_) particle = motion.advance(particle);
}

void ParticleFilter::disturb(const MotionModel& motion, Random& random) {
  const auto count = static_cast<double>(particles_.size());
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  double noise = 0.0;
  const Eigen::Vector2d origin = particles_.front().pixel;
  for (Particle& particle : particles_) {
    const Eigen::Vector2d offset = particle.pixel - origin;
    sum += offset;
    squares += offset * offset.transpose();
    noise += motion.position_sd(particle.size_px);
    particle = motion.disturbed(particle, random);
  }
  const Eigen::Vector2d mean = sum / count;
  const double sd = noise / count;
  predicted_mean_px_ = origin + mean;
  predicted_covariance_px2_ = squares / count - mean * mean.transpose();
  predicted_covariance_px2_ += sd * sd * Eigen::Matrix2d::Identity();
}

void ParticleFilter::move_half(const Eigen::Vector2d& step_px) {
  for (std::size_t i = 0; i < particles_.size(); i += 2) particles_[i].pixel += step_px;
  widen_prediction(step_px.norm());
}

void ParticleFilter::weigh_by_log_likelihood() {
  const double greatest = *std::max_element(log_likelihood_.begin(), log_likelihood_.end());
  weights_.assign(particles_.size(), 1.0);
  if (std::isfinite(greatest)) {
    for (std::size_t i = 0; i < weights_.size(); ++i) {
      weights_[i] = std::exp(log_likelihood_[i] - greatest);
    }
  }
  double sum = 0.0;
  for (const double weight : weights_) sum += weight;
  for (double& weight : weights_) weight /= sum;
}

std::size_t ParticleFilter::maximum_a_posteriori() const {
  const Eigen::Matrix2d information = predicted_covariance_px2_.inverse();
  std::size_t best = 0;
  double greatest = -INFINITY;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    const Eigen::Vector2d off = particles_[i].pixel - predicted_mean_px_;
    const double prior = std::log(std::exp(-0.5 * off.dot(information * off)) + kAnywhere);
    const double posterior = log_likelihood_[i] + prior;
    if (posterior > greatest) {
      greatest = posterior;
      best = i;
    }
  }
  return best;
}

Eigen::Vector2d ParticleFilter::mean_size_px() const {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < particles_.size(); ++i) mean += weights_[i] * particles_[i].size_px;
  return mean;
}

Eigen::Vector2d ParticleFilter::mean_velocity_px_s() const {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    mean += weights_[i] * particles_[i].velocity_px_s;
  }
  return mean;
}

Eigen::Matrix2d ParticleFilter::covariance_about(const Eigen::Vector2d& pixel) const {
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    const Eigen::Vector2d off = particles_[i].pixel - pixel;
    covariance += weights_[i] * off * off.transpose();
  }
  return covariance;
}

void ParticleFilter::resample(Random& random) {
  const std::size_t count = particles_.size();
  const double step = 1.0 / static_cast<double>(count);
  double at = random.uniform() * step;
  double sum = weights_.front();
  std::size_t source = 0;
  resampled_.clear();
  resampled_.reserve(count);
  for (std::size_t i = 0; i < count; ++i, at += step) {
    while (at > sum && source + 1 < count) sum += weights_[++source];
    resampled_.push_back(particles_[source]);
  }
  particles_.swap(resampled_);
  weights_.assign(count, step);
}

}  // namespace ols::tracker
