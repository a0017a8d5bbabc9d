#include "edge/tracker/reacquisition.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ols::tracker {
namespace {

constexpr double kNearFirst_s = 1.0;  // search for a lost target nearby, then anywhere

}  // namespace

void Reacquisition::restart(const Particle& target) {
  believed_ = target;
  region_.reset();
  measured_ = false;
}

void Reacquisition::end() {
  believed_identity_ = identity_;
  region_.reset();
}

void Reacquisition::learn_velocity(bool measured, const Eigen::Vector2d& unmoved_px,
                                   double interval_s, Particle& target) {
  const Eigen::Vector2d velocity_px_s = (target.pixel - unmoved_px) / interval_s;
  const bool leapt = velocity_px_s.norm() > config_.leap_most_px_s;
  if (region_ && measured_before_ && measured && !leapt) target.velocity_px_s = velocity_px_s;
  measured_ = measured;
}

void Reacquisition::start(double sd_px) {
  region_ = Region{believed_.pixel, sd_px, config_.search_sd_most_px, time_s_, false};
}

void Reacquisition::start_near(const Eigen::Vector2d& pixel, double sd_px) {
  region_ = Region{pixel, sd_px, std::max(sd_px, config_.search_sd_most_px), time_s_, true};
  believed_.pixel = pixel;
  measured_ = false;
  believed_identity_ = 1.0;  // a caller who reports the place knows which target it is
}

void Reacquisition::predict(const MotionModel& motion, const SceneMotion& scene, bool placed) {
  time_s_ = scene.time_s();
  measured_before_ = std::exchange(measured_, false);
  unaligned_since_s_ = scene.unaligned_since_s();
  movers_.clear();
  const cv::Size& frame = scene.frame_size();
  believed_ = bounded(placed ? believed_ : motion.advance(believed_), frame);
  if (!region_) return;
  Particle centre = believed_;
  centre.pixel = region_->pixel;
  if (region_->told) centre.velocity_px_s.setZero();
  if (!placed) region_->pixel = motion.advance(centre).pixel;
  region_->pixel =
      region_->pixel.cwiseMax(0.0).cwiseMin(Eigen::Vector2d(frame.width - 1.0, frame.height - 1.0));
  region_->sd_px = std::min(region_->sd_px + config_.search_growth_px_s * motion.interval_s(),
                            region_->most_sd_px);
}

void Reacquisition::scatter(std::vector<Particle>& particles, Random& random) const {
  const auto count =
      static_cast<std::size_t>(config_.search_fraction * static_cast<double>(particles.size()));
  for (std::size_t i = 0; i < count; ++i) {
    // Evenly among the resampled ones, which are in the order of their ancestors.
    particles[i * particles.size() / count] = drawn_near(region_->pixel, region_->sd_px, random);
  }
}

Particle Reacquisition::drawn_near(const Eigen::Vector2d& pixel, double sd_px,
                                   Random& random) const {
  Particle particle = believed_;
  const double x = random.gaussian();
  const double y = random.gaussian();
  particle.pixel = pixel + sd_px * Eigen::Vector2d(x, y);
  const double vx = random.gaussian();
  const double vy = random.gaussian();
  // With the same velocity, or zero: it may have turned meanwhile.
  if (random.uniform() < 0.5) particle.velocity_px_s.setZero();
  particle.velocity_px_s += config_.initial_velocity_sd_px_s * Eigen::Vector2d(vx, vy);
  return particle;
}

void Reacquisition::look_for_movers(const SceneMotion& scene, const Eigen::Vector2d& size_px) {
  const auto* earlier = scene.a_moment_ago();
  if (!earlier) return;
  MoverSearch where;
  where.area = {{0.0, 0.0}, cv::Size2d(scene.frame_size())};
  if (looks_near_first()) {
    const double reach = 3.0 * region_->sd_px;
    where.area &= box_of(region_->pixel, size_px + Eigen::Vector2d::Constant(2.0 * reach));
  }
  movers_ = detect_movers(earlier->gray, earlier->to_present, scene.present(), where);
}

void Reacquisition::force_onto_movers(std::vector<Particle>& particles, Random& random) const {
  if (movers_.empty()) return;
  const auto count =
      static_cast<std::size_t>(config_.difference_fraction * static_cast<double>(particles.size()));
  for (std::size_t i = 0; i < count; ++i) {
    const MoverCandidate& mover = movers_[i % movers_.size()];
    const double sd = 1.0 + 0.1 * std::sqrt(believed_.size_px.prod());
    // Between those used for the frame difference.
    particles[i * particles.size() / count + 1] = drawn_near(mover.pixel, sd, random);
  }
}

bool Reacquisition::may_be_target(const Particle& particle) const {
  if (!region_ || region_->told || near_prediction(particle)) return true;
  const cv::Rect2d box = box_of(particle.pixel, particle.size_px);
  return std::any_of(movers_.begin(), movers_.end(),
                     [&](const auto& mover) { return (mover.box & box).area() > 0.0; });
}

bool Reacquisition::near_prediction(const Particle& particle) const {
  const double off_px = (particle.pixel - region_->pixel).norm();
  const double reach_px = 2.0 * region_->sd_px + particle.size_px.norm();
  return looks_near_first() && off_px < reach_px;
}

// After a cut or a shock the prediction is useless.
bool Reacquisition::looks_near_first() const {
  const bool same_scene = unaligned_since_s_ < region_->since_s - kNearFirst_s;
  return same_scene && time_s_ - region_->since_s < kNearFirst_s;
}

void Reacquisition::identify(const Particle& found, const Scene& scene, const TargetModel& target,
                             const Belief& belief) {
  if (!region_) return;
  identity_ = std::min(believed_identity_, identity_of(found, scene, target, belief));
}

double Reacquisition::identity_of(const Particle& found, const Scene& scene,
                                  const TargetModel& target, const Belief& belief) const {
  constexpr double kOutOfSight = 0.25;  // assumed hidden candidates
  if (region_->told || near_prediction(found)) return believed_identity_;
  const cv::Rect2d box = box_of(found.pixel, found.size_px);
  double others = kOutOfSight;
  for (const MoverCandidate& mover : movers_) {
    if ((mover.box & box).area() > 0.0) continue;
    double alike = 0.0;
    for (int k = 0; k < 9; ++k) {
      Particle there = found;
      there.pixel = mover.pixel + 2.0 * Eigen::Vector2d(k % 3 - 1, k / 3 - 1);
      alike = std::max(alike, belief.in_frame(target.evidence(scene, there)));
    }
    others += alike;
  }
  return 1.0 / (1.0 + others);
}

}  // namespace ols::tracker
