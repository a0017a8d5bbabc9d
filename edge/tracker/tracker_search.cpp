// How a target that is no longer believed in is looked for, and what may be taken for it.
#include <algorithm>
#include <cmath>

#include "edge/tracker/tracker_core.h"

namespace ols {
namespace {

constexpr double kEarlier = 0.2;    // [s] a small mover has left its own place by then
constexpr double kNearFirst = 1.0;  // [s] a lost target is looked for nearby, then anywhere

}  // namespace

void TrackerCore::search_near(const Eigen::Vector2d& designated, double sd_px) {
  const Eigen::Vector2d pixel = designated - label_.place.cwiseProduct(believed_.size_px);
  search_ = Search{pixel, sd_px, std::max(sd_px, config_.search_sd_most_px), time_s_, true};
  for (Particle& particle : filter_.particles()) particle = drawn_near(pixel, sd_px);
  last_.pixel = believed_.pixel = pixel;
  last_.size_px = believed_.size_px;
  belief_.doubt();
  forget_measured();
  believed_identity_ = 1.0;  // who tells where it is knows which one it is
  placed_ = true;
}

void TrackerCore::start_search(double interval_s) {
  const double sd = first_reach_px(interval_s);
  search_ = Search{believed_.pixel, sd, config_.search_sd_most_px, time_s_, false};
}

// Further from where the target was to be than it can have moved: a cut, or something else.
bool TrackerCore::beyond_reach(const Eigen::Vector2d& pixel, double interval_s) const {
  const double reach_px = 2.0 * first_reach_px(interval_s) + last_.size_px.norm();
  const Eigen::Vector2d off_px = pixel - believed_.pixel;
  const bool by_other = other_step_px_ && (off_px - *other_step_px_).norm() <= reach_px;
  return off_px.norm() > reach_px && !by_other;
}

// A bird beside the target may look more like it than itself in this frame: as long as what is
// where the target was to be can be believed in, nothing beyond its reach is it.
std::size_t TrackerCore::choose(const Scene& scene, double background, double interval_s) const {
  const auto& particles = filter_.particles();
  const std::size_t best = filter_.maximum_a_posteriori(log_likelihood_);
  const bool followed = !search_ && velocity_ == Velocity::kEstimated;
  if (!followed || !beyond_reach(particles[best].pixel, interval_s)) return best;
  std::optional<std::size_t> near;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (beyond_reach(particles[i].pixel, interval_s)) continue;
    if (!near || log_likelihood_[i] > log_likelihood_[*near]) near = i;
  }
  if (!near) return best;
  const FrameEvidence there = evidence_of(scene, particles[*near], background);
  return belief_.in_frame(there) >= kBelieved ? *near : best;
}

double TrackerCore::first_reach_px(double interval_s) const {
  return 2.0 * motion_.position_sd(last_.size_px) + config_.search_growth_px_s * interval_s;
}

void TrackerCore::predict_search(double interval_s) {
  Particle centre = believed_;
  centre.pixel = search_->pixel;
  if (search_->told) centre.velocity_px_s.setZero();
  if (!placed_) search_->pixel = motion_.advance(centre).pixel;
  search_->pixel = search_->pixel.cwiseMax(0.0).cwiseMin(
      Eigen::Vector2d(frame_size_.width - 1.0, frame_size_.height - 1.0));
  search_->sd_px =
      std::min(search_->sd_px + config_.search_growth_px_s * interval_s, search_->most_sd_px);
  scatter_over_search(config_.search_fraction);
}

void TrackerCore::scatter_over_search(double fraction) {
  auto& particles = filter_.particles();
  const auto count = static_cast<std::size_t>(fraction * static_cast<double>(particles.size()));
  for (std::size_t i = 0; i < count; ++i) {
    // Evenly among the resampled ones, which stand in order of their ancestors.
    particles[i * particles.size() / count] = drawn_near(search_->pixel, search_->sd_px);
  }
}

Particle TrackerCore::drawn_near(const Eigen::Vector2d& pixel, double sd_px) {
  Particle particle = believed_;
  const double x = random_.gaussian();
  const double y = random_.gaussian();
  particle.pixel = pixel + sd_px * Eigen::Vector2d(x, y);
  const double vx = random_.gaussian();
  const double vy = random_.gaussian();
  // On as before, or no longer: it may have turned meanwhile.
  if (random_.uniform() < 0.5) particle.velocity_px_s.setZero();
  particle.velocity_px_s += config_.initial_velocity_sd_px_s * Eigen::Vector2d(vx, vy);
  return particle;
}

// While the target is lost: things that move, near where it should be first, then anywhere.
void TrackerCore::find_movers(const ReducedFrame& reduced) {
  const auto* earlier = references_.older_than(time_s_ - kEarlier);
  if (!earlier) return;
  MoverSearch where;
  where.area = {{0.0, 0.0}, cv::Size2d(frame_size_)};
  if (looks_near_first()) {
    const double reach = 3.0 * search_->sd_px;
    where.area &= box_of(search_->pixel, last_.size_px + Eigen::Vector2d::Constant(2.0 * reach));
  }
  movers_ = detect_movers(earlier->gray, earlier->to_present, reduced, where);
}

void TrackerCore::force_onto_movers() {
  if (movers_.empty()) return;
  auto& particles = filter_.particles();
  const auto count =
      static_cast<std::size_t>(config_.difference_fraction * static_cast<double>(particles.size()));
  for (std::size_t i = 0; i < count; ++i) {
    const MoverCandidate& mover = movers_[i % movers_.size()];
    const double sd = 1.0 + 0.1 * std::sqrt(believed_.size_px.prod());
    // Between those that the frame difference took.
    Particle& particle = particles[i * particles.size() / count + 1];
    particle = drawn_near(mover.pixel, sd);
  }
}

// A distant target that was lost comes back near where it should be, or moving. What stands still
// against the scene elsewhere is a twig, a window or a reticle, however much it looks like it.
bool TrackerCore::may_be_it(const Particle& particle) const {
  if (!search_ || search_->told || near_prediction(particle)) return true;
  const cv::Rect2d box = box_of(particle.pixel, particle.size_px);
  return std::any_of(movers_.begin(), movers_.end(),
                     [&](const auto& mover) { return (mover.box & box).area() > 0.0; });
}

bool TrackerCore::near_prediction(const Particle& particle) const {
  const double off_px = (particle.pixel - search_->pixel).norm();
  const double reach_px = 2.0 * search_->sd_px + particle.size_px.norm();
  return looks_near_first() && off_px < reach_px;
}

// After a cut, or a kick, the prediction tells nothing.
bool TrackerCore::looks_near_first() const {
  const bool same_scene = scene_since_s_ < search_->since_s - kNearFirst;
  return same_scene && time_s_ - search_->since_s < kNearFirst;
}

// What is found elsewhere is one of all that move and look like the target, or of those that are
// out of sight: nobody can tell which.
double TrackerCore::identity_of_found(const Scene& scene, double background) const {
  constexpr double kOutOfSight = 0.25;  // as many more
  if (search_->told || near_prediction(last_)) return believed_identity_;
  const cv::Rect2d box = box_of(last_.pixel, last_.size_px);
  double others = kOutOfSight;
  for (const MoverCandidate& mover : movers_) {
    if ((mover.box & box).area() > 0.0) continue;
    double alike = 0.0;
    for (int k = 0; k < 9; ++k) {
      Particle there = last_;
      there.pixel = mover.pixel + 2.0 * Eigen::Vector2d(k % 3 - 1, k / 3 - 1);
      alike = std::max(alike, belief_.in_frame(evidence_of(scene, there, background)));
    }
    others += alike;
  }
  return 1.0 / (1.0 + others);
}

bool TrackerCore::scene_unknown() const {
  return references_.older_than(time_s_ - kEarlier) == nullptr;
}

}  // namespace ols
