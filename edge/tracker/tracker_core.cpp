#include "edge/tracker/tracker_core.h"

#include <algorithm>
#include <cmath>

#include "edge/tracker/core_box.h"
#include "edge/tracker/difference_candidates.h"

namespace ols {
namespace {

constexpr double kSamePattern = 0.5;  // correlation; less is no measurement of its place
constexpr double kSameShape = 0.9;    // likewise; less is no measurement of its size
constexpr double kNotPlaced = 0.1;    // of its size: 1 sigma where nothing tells its place better
constexpr double kSharedByChance = 1.2;  // so much of it white noise has, by fluctuating
constexpr double kSharedNoiseTime_s = 1.0;
constexpr double kAgree = 2.0;  // sigmas of a step
constexpr double kSureEnoughToLearn = 0.7;
constexpr double kSureEnoughForMask = 0.8;

// A target in a generous box moves as far as the box says, however small it is itself.
TrackerConfig with_reach_of(const cv::Rect2d& box, const cv::Rect2d& core, TrackerConfig config) {
  config.position_sd_fraction *= std::sqrt(box.area() / core.area());
  return config;
}

}  // namespace

TrackerCore::TrackerCore(const TrackerConfig& config, std::uint64_t seed, const TrackerInput& frame,
                         const cv::Rect2d& box)
    : TrackerCore(config, seed, frame, box, find_core(frame.gray, box)) {}

TrackerCore::TrackerCore(const TrackerConfig& config, std::uint64_t seed, const TrackerInput& frame,
                         const cv::Rect2d& box, const cv::Rect2d& core)
    : config_(config),
      random_(seed),
      ego_motion_(config),
      reduced_(reduce_frame(frame.gray, config.ego_motion_width_px)),
      motion_(with_reach_of(box, core, config)),
      target_(config, frame.gray, core),
      references_(config.reference_interval_s),
      designated_(box),
      frame_size_(frame.gray.size()),
      time_s_(frame.time_s) {
  last_.pixel = centre_of(core);
  last_.size_px = size_of(core);
  label_.place = (centre_of(box) - last_.pixel).cwiseQuotient(last_.size_px);
  label_.scale = size_of(box).cwiseQuotient(last_.size_px);
  believed_ = last_;
  filter_.particles().assign(static_cast<std::size_t>(config.particles), last_);
  ego_motion_.start(reduced_);
  references_.offer(frame.gray, frame.time_s, core);
  belief_.start();
}

Eigen::Vector2d TrackerCore::designated_point(const Particle& particle) const {
  return particle.pixel + label_.place.cwiseProduct(particle.size_px);
}

cv::Rect2d TrackerCore::labelled(const Particle& particle) const {
  return box_of(designated_point(particle), label_.scale.cwiseProduct(particle.size_px));
}

TrackerOutput TrackerCore::step(const TrackerInput& frame, StageTimer& timer) {
  const double interval_s = usable_interval_s(time_s_, frame.time_s);
  time_s_ = frame.time_s;
  const ReducedFrame reduced = reduce_frame(frame.gray, config_.ego_motion_width_px);
  timer.lap(Stage::kReduction);
  const EgoMotion ego_motion = move_camera(frame, reduced, interval_s);
  timer.lap(Stage::kEgoMotion);
  if (target_.empty()) designate_late(frame.gray);
  predict(ego_motion, reduced, interval_s, timer);
  timer.lap(Stage::kPrediction);
  TrackerOutput output = update(frame, interval_s, timer);
  output.ego_motion = ego_motion;
  after_update(output, interval_s);
  references_.offer(frame.gray, frame.time_s, box_of(last_.pixel, last_.size_px));
  reduced_ = reduced;
  filter_.resample(random_);
  propose_usual_size();
  timer.lap(Stage::kLearning);
  return output;
}

EgoMotion TrackerCore::move_camera(const TrackerInput& frame, const ReducedFrame& reduced,
                                   double interval_s) {
  const cv::Rect2d box = box_of(last_.pixel, last_.size_px);
  const auto estimate = ego_motion_.step(reduced, box, frame.predicted_homography);
  image_homography_ = estimate.homography;
  other_step_px_.reset();
  if (image_homography_ && frame.predicted_homography) {
    const Eigen::Vector2d apart = transform(*frame.predicted_homography, last_.pixel) -
                                  transform(*image_homography_, last_.pixel);
    if (apart.norm() > kAgree * motion_.position_sd(last_.size_px)) other_step_px_ = apart;
  }
  EgoMotion source = EgoMotion::kNone;
  CameraMotion motion{estimate.homography, interval_s};
  if (motion.homography) {
    source = EgoMotion::kImage;
  } else if (frame.predicted_homography) {
    motion.homography = frame.predicted_homography;
    source = EgoMotion::kPredicted;
  }
  scene_lost_ = motion_.homography() && !motion.homography;
  const Eigen::Vector2d change_px_s = motion_.begin_frame(motion, last_.pixel);
  for (Particle& particle : filter_.particles()) particle.velocity_px_s += change_px_s;
  if (velocity_ == Velocity::kEstimated) {  // of a new target there is none to go on
    last_.velocity_px_s += change_px_s;
    believed_.velocity_px_s += change_px_s;
  }
  if (motion.homography) {
    references_.advance(*motion.homography);
  } else if (!estimate.featureless) {
    references_.clear();  // a sky without features looks the same wherever the camera turned
    scene_since_s_ = time_s_;
  }
  return source;
}

void TrackerCore::predict(EgoMotion ego_motion, const ReducedFrame& reduced, double interval_s,
                          StageTimer& timer) {
  if (placed_ || velocity_ == Velocity::kUnknown) guess_velocities();
  if (placed_) {
    // search_near() spoke of this frame's pixels: undo the step that follows.
    const auto step_back = [this](Particle& p) { p.pixel -= motion_.advance(p).pixel - p.pixel; };
    for (Particle& particle : filter_.particles()) step_back(particle);
    step_back(last_);
    step_back(believed_);
  }
  filter_.predict(motion_, random_);
  if (other_step_px_) move_half_by_other();
  believed_ = bounded(motion_.advance(believed_), frame_size_);
  if (search_) predict_search(interval_s);
  timer.lap(Stage::kPrediction);
  if (ego_motion == EgoMotion::kNone) {
    force_onto_differences(reduced, {{0.0, 0.0}, cv::Size2d(frame_size_)});
  } else if (search_ || velocity_ == Velocity::kUnknown) {
    force_onto_differences(reduced, reachable_area(interval_s));
  }
  movers_.clear();
  if (search_ && !target_.empty()) {
    find_movers(reduced);
    force_onto_movers();
  }
  timer.lap(Stage::kProposals);
  for (Particle& particle : filter_.particles()) particle = bounded(particle, frame_size_);
  if (velocity_ == Velocity::kUnknown) {
    filter_.widen_prediction(config_.leap_most_px_s * interval_s / 3.0);
  }
  placed_ = false;
}

// Picture and mount tell different motions: dirt on the lens and burnt-in text stand still in the
// one, a slipped gear in the other. The target's own look decides.
void TrackerCore::move_half_by_other() {
  auto& particles = filter_.particles();
  for (std::size_t i = 0; i < particles.size(); i += 2) particles[i].pixel += *other_step_px_;
  filter_.widen_prediction(other_step_px_->norm());
}

// Nothing stood out in the designated box: a bird with its wings edgewise, a drone behind a twig.
// What stands out there soon after is what was meant.
void TrackerCore::designate_late(const cv::Mat& gray) {
  constexpr double kWider = 1.8;
  constexpr double kLongest = 2.0;  // [s]
  Particle designated{motion_.still(centre_of(designated_)), {}, size_of(designated_)};
  designated = bounded(designated, frame_size_);
  designated_ = box_of(designated.pixel, designated.size_px);
  empty_s_ += motion_.interval_s();
  if (empty_s_ > kLongest) return;
  const cv::Rect2d wide = box_of(centre_of(designated_), kWider * size_of(designated_));
  const cv::Rect2d core = find_core(gray, wide);
  if (core == wide) return;
  target_ = TargetModel(config_, gray, core);
  forget_measured();
  last_.pixel = centre_of(core);
  last_.size_px = size_of(core);
  last_.velocity_px_s.setZero();
  believed_ = last_;
  label_.place.setZero();
  label_.scale = size_of(designated_).cwiseQuotient(last_.size_px);
  filter_.particles().assign(filter_.particles().size(), last_);
  velocity_ = Velocity::kUnknown;
  search_.reset();
  placed_ = true;
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
  weigh_particles(scene, background);
  const std::size_t best = choose(scene, background, interval_s);
  last_ = filter_.particles()[best];
  last_.size_px = filter_.mean_size_px();
  timer.lap(Stage::kWeighting);

  TrackerOutput output = locate(scene, best, interval_s);
  timer.lap(Stage::kPosition);
  judge(scene, background, interval_s);
  output.box = labelled(last_);
  output.belief = identity_ * belief_.value();
  return output;
}

// The designated point, where the target is placed, and its covariance.
TrackerOutput TrackerCore::locate(const Scene& scene, std::size_t best, double interval_s) {
  const double floor = config_.pixel_sd_floor_px * config_.pixel_sd_floor_px;
  TrackerOutput output;
  const auto placed = target_.place(scene, last_.pixel, last_.size_px);
  if (placed && placed->correlation > kSamePattern) {
    last_.pixel = filter_.particles()[best].pixel = placed->centre;
    const RefinedPosition measured = measure(scene, *placed);
    learn_shared_noise(measured.shared_noise, interval_s);
    output.pixel = measured.point(label_.place);
    output.covariance_px2 = std::max(1.0, shared_noise_ / kSharedByChance) *
                            measured.point_covariance_px2(label_.place);
  } else {
    measured_size_px_.reset();
    output.pixel = designated_point(last_);
    output.covariance_px2 = filter_.covariance_about(last_.pixel);
    output.covariance_px2.diagonal() += (kNotPlaced * last_.size_px).cwiseAbs2();
  }
  output.covariance_px2.diagonal().array() += floor;
  return output;
}

// What is followed goes by a size that the particles agree on, which no smeared image leads astray;
// what is told, by the one that this image shows.
RefinedPosition TrackerCore::measure(const Scene& scene, const RefinedPosition& placed) {
  const auto measured = target_.measure(scene, placed, measured_size_px_.value_or(last_.size_px));
  measured_size_px_.reset();
  if (!measured || measured->correlation < kSamePattern) return placed;
  if (measured->correlation > kSameShape) measured_size_px_ = measured->size_px;
  return *measured;
}

// A target that comes nearer grows by more than particles find by chance. Evenly among the
// resampled ones, which stand in order of their ancestors.
void TrackerCore::propose_usual_size() {
  constexpr std::size_t kEvery = 8;
  constexpr double kOff = 0.15;
  const Eigen::Vector2d& usual = target_.usual_size_px();
  const Eigen::Vector2d off = usual.cwiseQuotient(last_.size_px).array().log();
  if (off.cwiseAbs().maxCoeff() < kOff) return;
  auto& particles = filter_.particles();
  for (std::size_t i = 0; i < particles.size(); i += kEvery) particles[i].size_px = usual;
}

// The mean of the first ones, and of the last second then: of one frame it is much by chance.
void TrackerCore::learn_shared_noise(double shared_noise, double interval_s) {
  const double share =
      std::max(1.0 / ++shared_noise_count_, 1.0 - std::exp(-interval_s / kSharedNoiseTime_s));
  shared_noise_ += share * (shared_noise - shared_noise_);
}

void TrackerCore::forget_measured() {
  measured_size_px_.reset();
  shared_noise_count_ = 0;
}

void TrackerCore::weigh_particles(const Scene& scene, double background) {
  constexpr double kStill = 5.0;  // so much less likely, as a logarithm
  log_likelihood_.clear();
  for (const Particle& particle : filter_.particles()) {
    const Likeness likeness = target_.likeness(scene, particle.pixel, particle.size_px);
    const double out = target_.standing_out(scene, particle.pixel, particle.size_px);
    const double alike = target_.log_likelihood(likeness, background, out, particle.size_px);
    log_likelihood_.push_back(may_be_it(particle) ? alike : alike - kStill);
  }
  filter_.weigh(log_likelihood_);
}

FrameEvidence TrackerCore::evidence_of(const Scene& scene, const Particle& particle,
                                       double background) const {
  const auto& [pixel, velocity_px_s, size_px] = particle;
  const Likeness found = target_.likeness(scene, pixel, size_px);
  FrameEvidence evidence{found.similarity, background, found.correlation, found.contrast};
  evidence.standing_out = target_.standing_out(scene, pixel, size_px);
  evidence.foreground = target_.foreground(scene, pixel, size_px);
  evidence.by_subtraction = scene.mask_by_subtraction;
  return evidence;
}

// How far what was found is believed in, and what is learnt from it.
void TrackerCore::judge(const Scene& scene, double background, double interval_s) {
  const FrameEvidence evidence = evidence_of(scene, last_, background);
  belief_.update(evidence, interval_s);
  // What is new where the scene was known is as good as a mover.
  const bool is_new = evidence.by_subtraction && evidence.foreground > 0.5;
  const bool cut = scene_unknown() || (!search_ && scene_lost_);
  const bool told_by_look = cut && belief_.usual(evidence);
  const bool leapt = !search_ && velocity_ == Velocity::kEstimated &&
                     beyond_reach(last_.pixel, interval_s) && !told_by_look;
  if (leapt) start_search(interval_s);
  velocity_ = Velocity::kEstimated;
  const bool elsewhere = !may_be_it(last_) && !is_new && !told_by_look;
  if (target_.empty() || leapt || elsewhere) belief_.doubt();
  if (search_) identity_ = std::min(believed_identity_, identity_of_found(scene, background));
  if (belief_.value() > kSureEnoughForMask) target_.learn_mask(scene, last_.pixel, last_.size_px);
  if (belief_.value() > kSureEnoughToLearn) {
    const double share = 1.0 - std::exp(-interval_s / config_.learning_time_s);
    target_.learn(scene, last_.pixel, last_.size_px, share);
    if (measured_size_px_) target_.learn_size(*measured_size_px_, share);
  }
}

void TrackerCore::after_update(const TrackerOutput& output, double interval_s) {
  // A frame that shows something else says nothing of where the target is, however sure one was.
  if (belief_.of_frame() >= kBelieved && output.belief >= kBelieved) {
    believed_ = last_;
    believed_.velocity_px_s = filter_.mean_velocity_px_s();
  }
  if (output.belief >= kBelieved) {
    believed_identity_ = identity_;
    search_.reset();
  } else if (!search_) {
    start_search(interval_s);
  }
}

}  // namespace ols
