#include "edge/tracker/motion_model.h"

#include <algorithm>
#include <cmath>

namespace ols::tracker {
namespace {

constexpr double kLeastSide = 3.0;  // [px] smaller boxes contain no pattern

Eigen::Vector2d noise(Random& random, double sd) {
  const double x = random.gaussian();
  const double y = random.gaussian();
  return {sd * x, sd * y};
}

}  // namespace

double usable_interval_s(double from_s, double to_s) {
  return std::clamp(to_s - from_s, 1e-4, 1.0);
}

Particle bounded(const Particle& particle, const cv::Size& frame) {
  const Eigen::Vector2d whole(frame.width, frame.height);
  const double fastest_px_s = 10.0 * frame.width;
  Particle inside = particle;
  inside.pixel = particle.pixel.cwiseMax(-whole).cwiseMin(2.0 * whole);
  inside.velocity_px_s = particle.velocity_px_s.cwiseMax(-fastest_px_s).cwiseMin(fastest_px_s);
  inside.size_px = particle.size_px.cwiseMin(whole).cwiseMax(kLeastSide);
  return inside;
}

Eigen::Vector2d MotionModel::begin_frame(const CameraMotion& motion, const Eigen::Vector2d& pixel) {
  motion_ = motion;
  if (!motion.homography) {
    rate_known_ = false;
    return Eigen::Vector2d::Zero();
  }
  const Eigen::Vector2d rate = (transform(*motion.homography, pixel) - pixel) / motion.interval_s;
  Eigen::Vector2d change = Eigen::Vector2d::Zero();
  if (!rate_known_) change = camera_rate_px_s_ - rate;
  camera_rate_px_s_ = rate;
  rate_known_ = true;
  return change;
}

Eigen::Vector2d MotionModel::still(const Eigen::Vector2d& pixel) const {
  if (motion_.homography) return transform(*motion_.homography, pixel);
  return pixel + camera_rate_px_s_ * motion_.interval_s;
}

Particle MotionModel::advance(const Particle& particle) const {
  Particle next = particle;
  next.pixel = still(particle.pixel) + particle.velocity_px_s * motion_.interval_s;
  return next;
}

double MotionModel::position_sd(const Eigen::Vector2d& size_px) const {
  const double known =
      config_.position_sd_px + config_.position_sd_fraction * std::sqrt(size_px.x() * size_px.y());
  return motion_.homography ? known : std::hypot(known, config_.unknown_motion_sd_px);
}

Particle MotionModel::disturbed(const Particle& particle, Random& random) const {
  const bool surprised = random.uniform() < config_.surprise_fraction;
  const double sd = position_sd(particle.size_px) * (surprised ? config_.surprise_scale : 1.0);
  const Eigen::Vector2d moved = noise(random, sd);
  Particle next = particle;
  next.pixel += moved;  // eq. (2)
  // Eq. (3): an acceleration moves the target off its course, so the two noises are correlated, and
  // selecting positions also selects velocities.
  next.velocity_px_s +=
      config_.velocity_gain * moved / motion_.interval_s + noise(random, config_.velocity_sd_px_s);
  const Eigen::Vector2d growth = noise(random, config_.size_sd_fraction);
  next.size_px = particle.size_px.cwiseProduct(Eigen::Vector2d::Ones() + growth);  // eq. (4)
  next.size_px = next.size_px.cwiseMax(kLeastSide);
  return next;
}

}  // namespace ols::tracker
