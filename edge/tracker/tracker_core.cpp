#include "edge/tracker/tracker_core.h"

#include <algorithm>
#include <cmath>

#include "edge/tracker/difference_candidates.h"

namespace ols {
namespace {

constexpr double kBelieved = 0.5;
constexpr double kSureEnoughForMask = 0.8;

}  // namespace

TrackerCore::TrackerCore(const TrackerConfig& config, std::uint64_t seed, const TrackerInput& frame,
                         const cv::Rect2d& box)
    : config_(config),
      random_(seed),
      ego_motion_(config),
      reduced_(reduce_frame(frame.gray, config.ego_motion_width_px)),
      motion_(config),
      target_(config, frame.gray, box),
      references_(config.reference_interval_s),
      frame_size_(frame.gray.size()),
      time_s_(frame.time_s) {
  last_.pixel = centre_of(box);
  last_.size_px = size_of(box);
  believed_ = last_;
  filter_.particles().assign(static_cast<std::size_t>(config.particles), last_);
  ego_motion_.start(reduced_);
  references_.offer(frame.gray, frame.time_s, box);
  belief_.start();
}

TrackerOutput TrackerCore::step(const TrackerInput& frame, StageTimer& timer) {
  const double interval_s = frame.time_s - time_s_;
  time_s_ = frame.time_s;
  const ReducedFrame reduced = reduce_frame(frame.gray, config_.ego_motion_width_px);
  timer.lap(Stage::kReduction);
  const EgoMotion ego_motion = move_camera(frame, reduced, interval_s);
  timer.lap(Stage::kEgoMotion);
  predict(ego_motion, reduced, interval_s);
  timer.lap(Stage::kPrediction);
  TrackerOutput output = update(frame, interval_s, timer);
  output.ego_motion = ego_motion;
  after_update(output, interval_s);
  references_.offer(frame.gray, frame.time_s, output.box);
  reduced_ = reduced;
  filter_.resample(random_);
  timer.lap(Stage::kLearning);
  return output;
}

EgoMotion TrackerCore::move_camera(const TrackerInput& frame, const ReducedFrame& reduced,
                                   double interval_s) {
  const cv::Rect2d box = box_of(last_.pixel, last_.size_px);
  const auto estimate = ego_motion_.step(reduced, box, frame.predicted_homography);
  EgoMotion source = EgoMotion::kNone;
  CameraMotion motion{estimate.homography, interval_s};
  if (motion.homography) {
    source = EgoMotion::kImage;
  } else if (frame.predicted_homography) {
    motion.homography = frame.predicted_homography;
    source = EgoMotion::kPredicted;
  }
  motion_.begin_frame(motion, last_.pixel, filter_.particles());
  if (motion.homography) {
    references_.advance(*motion.homography);
  } else if (!estimate.featureless) {
    references_.clear();  // a sky without features looks the same wherever the camera turned
  }
  return source;
}

void TrackerCore::predict(EgoMotion ego_motion, const ReducedFrame& reduced, double interval_s) {
  if (placed_ || velocity_ == Velocity::kUnknown) guess_velocities();
  if (placed_) {
    // search_near() spoke of this frame's pixels: undo the step that follows.
    const auto step_back = [this](Particle& p) { p.pixel -= motion_.advance(p).pixel - p.pixel; };
    for (Particle& particle : filter_.particles()) step_back(particle);
    step_back(last_);
  }
  filter_.predict(motion_, random_);
  if (search_) predict_search(interval_s);
  if (ego_motion == EgoMotion::kNone) {
    force_onto_differences(reduced, {{0.0, 0.0}, cv::Size2d(frame_size_)});
  } else if (search_ || velocity_ == Velocity::kUnknown) {
    force_onto_differences(reduced, reachable_area(interval_s));
  }
  if (velocity_ == Velocity::kUnknown) {
    filter_.widen_prediction(config_.leap_most_px_s * interval_s / 3.0);
  }
  velocity_ = Velocity::kEstimated;
  placed_ = false;
}

void TrackerCore::predict_search(double interval_s) {
  Particle centre = believed_;
  centre.pixel = search_->pixel;
  if (!placed_) search_->pixel = motion_.advance(centre).pixel;
  search_->pixel = search_->pixel.cwiseMax(0.0).cwiseMin(
      Eigen::Vector2d(frame_size_.width - 1.0, frame_size_.height - 1.0));
  search_->sd_px =
      std::min(search_->sd_px + config_.search_growth_px_s * interval_s, search_->most_sd_px);
  scatter_over_search(config_.search_fraction);
}

// Where a target of unknown velocity may be found.
cv::Rect2d TrackerCore::reachable_area(double interval_s) const {
  const Eigen::Vector2d centre = search_ ? search_->pixel : motion_.still(last_.pixel);
  const double reach = config_.leap_most_px_s * interval_s + (search_ ? 2.0 * search_->sd_px : 0.0);
  return box_of(centre, last_.size_px + Eigen::Vector2d::Constant(2.0 * reach));
}

// A new target either stands against the scene, or was being followed and stands in the image.
void TrackerCore::guess_velocities() {
  bool with_camera = false;
  for (Particle& particle : filter_.particles()) {
    particle.velocity_px_s = with_camera ? motion_.image_fixed_velocity() : Eigen::Vector2d::Zero();
    particle.velocity_px_s.x() += config_.initial_velocity_sd_px_s * random_.gaussian();
    particle.velocity_px_s.y() += config_.initial_velocity_sd_px_s * random_.gaussian();
    with_camera = !with_camera;
  }
}

Particle TrackerCore::drawn_near(const Eigen::Vector2d& pixel, double sd_px) {
  Particle particle = believed_;
  const double x = random_.gaussian();
  const double y = random_.gaussian();
  particle.pixel = pixel + sd_px * Eigen::Vector2d(x, y);
  const double vx = random_.gaussian();
  const double vy = random_.gaussian();
  particle.velocity_px_s += config_.initial_velocity_sd_px_s * Eigen::Vector2d(vx, vy);
  return particle;
}

void TrackerCore::scatter_over_search(double fraction) {
  auto& particles = filter_.particles();
  const auto count = static_cast<std::size_t>(fraction * static_cast<double>(particles.size()));
  for (std::size_t i = 0; i < count; ++i) {
    // Evenly among the resampled ones, which stand in order of their ancestors.
    particles[i * particles.size() / count] = drawn_near(search_->pixel, search_->sd_px);
  }
}

void TrackerCore::force_onto_differences(const ReducedFrame& reduced, const cv::Rect2d& area) {
  constexpr int kMaxima = 5;
  const bool moves_unknown = search_ || velocity_ == Velocity::kUnknown;
  const auto maxima =
      difference_candidates(reduced_, reduced, motion_.homography(), area, last_.size_px, kMaxima);
  if (maxima.empty()) return;
  auto& particles = filter_.particles();
  const auto count =
      static_cast<std::size_t>(config_.difference_fraction * static_cast<double>(particles.size()));
  for (std::size_t i = 0; i < count; ++i) {
    Particle& particle = particles[i * particles.size() / count];
    const double x = random_.gaussian();
    const double y = random_.gaussian();
    particle.pixel =
        maxima[i % maxima.size()] + 0.1 * Eigen::Vector2d(x, y).cwiseProduct(particle.size_px);
    // The leap since the last frame tells the velocity, if the target was there then.
    if (moves_unknown && random_.uniform() < 0.5) {
      particle.velocity_px_s = motion_.velocity_between(last_.pixel, particle.pixel);
    }
  }
}

TrackerOutput TrackerCore::update(const TrackerInput& frame, double interval_s, StageTimer& timer) {
  const cv::Rect2d expected = box_of(motion_.advance(last_).pixel, last_.size_px);
  const Scene scene = target_.make_scene(frame.gray, filter_.particles(), expected, references_);
  timer.lap(Stage::kMasks);
  const double background = target_.background_similarity(scene, expected);
  std::vector<double> log_likelihood;
  for (const Particle& particle : filter_.particles()) {
    const Likeness likeness = target_.likeness(scene, particle.pixel, particle.size_px);
    log_likelihood.push_back(target_.log_likelihood(likeness, background, particle.size_px));
  }
  filter_.weigh(log_likelihood);
  const std::size_t best = filter_.maximum_a_posteriori(log_likelihood);
  last_ = filter_.particles()[best];
  last_.size_px = filter_.mean_size_px();
  timer.lap(Stage::kWeighting);

  const auto refined = target_.refine(scene, last_.pixel, last_.size_px);
  const double floor = config_.pixel_sd_floor_px * config_.pixel_sd_floor_px;
  TrackerOutput output;
  output.covariance_px2 = filter_.covariance_about(last_.pixel);
  if (refined) {
    last_.pixel = refined->pixel;
    filter_.particles()[best].pixel = refined->pixel;
    output.covariance_px2 = refined->covariance_px2;
  }
  output.covariance_px2 += floor * Eigen::Matrix2d::Identity();
  timer.lap(Stage::kPosition);
  const Likeness found = target_.likeness(scene, last_.pixel, last_.size_px);
  belief_.update({found.similarity, background, found.correlation, found.contrast}, interval_s);
  if (target_.empty()) belief_.doubt();
  if (belief_.value() > kSureEnoughForMask) target_.learn_mask(scene, last_.pixel, last_.size_px);
  output.box = box_of(last_.pixel, last_.size_px);
  output.pixel = last_.pixel;
  output.belief = belief_.value();
  return output;
}

void TrackerCore::after_update(const TrackerOutput& output, double interval_s) {
  if (output.belief >= kBelieved) {
    believed_ = last_;
    believed_.velocity_px_s = filter_.mean_velocity_px_s();
    search_.reset();
  } else if (!search_) {
    const double sd =
        2.0 * motion_.position_sd(last_.size_px) + config_.search_growth_px_s * interval_s;
    search_ = Search{last_.pixel, sd, config_.search_sd_most_px};
  }
}

void TrackerCore::search_near(const Eigen::Vector2d& pixel, double sd_px) {
  search_ = Search{pixel, sd_px, std::max(sd_px, config_.search_sd_most_px)};
  for (Particle& particle : filter_.particles()) particle = drawn_near(pixel, sd_px);
  last_.pixel = pixel;
  last_.size_px = believed_.size_px;
  belief_.doubt();
  placed_ = true;
}

}  // namespace ols
