#include "edge/tracker/tracker_core.h"

#include <algorithm>
#include <cmath>

#include "edge/tracker/core_box.h"
#include "edge/tracker/difference_candidates.h"

namespace ols::tracker {
namespace {

constexpr double kNotPlaced = 0.1;  // of its size: 1-sigma of a place that is not measured
constexpr double kAgree = 2.0;      // sigmas of a step
// Of the usual response of the learnt appearance, which follows, finds again, learns.
constexpr double kFollowed = 0.35, kFoundAgain = 0.5, kLearnt = 0.6;
constexpr double kSureEnoughToLearn = 0.7, kSureEnoughForMask = 0.8;

// A target in a generous box moves in proportion to the box, however small it is.
TrackerConfig with_reach_of(const cv::Rect2d& box, const cv::Rect2d& core, TrackerConfig config) {
  config.position_sd_fraction *= std::sqrt(box.area() / core.area());
  return config;
}

Particle at_rest_in(const cv::Rect2d& box) {
  return {centre_of(box), Eigen::Vector2d::Zero(), size_of(box)};
}

}  // namespace

TrackerCore::TrackerCore(const TrackerConfig& config, std::uint64_t seed, const TrackerInput& frame,
                         const cv::Rect2d& box)
    : TrackerCore(config, seed, frame, box, find_core(frame.gray, box)) {}

TrackerCore::TrackerCore(const TrackerConfig& config, std::uint64_t seed, const TrackerInput& frame,
                         const cv::Rect2d& box, const cv::Rect2d& core)
    : config_(config),
      random_(seed),
      scene_motion_(config, HomographyFit::kLeastSquares, frame, core),
      motion_(with_reach_of(box, core, config)),
      target_(config, frame.gray, core),
      recognition_(frame, centre_of(core), size_of(core)),
      designation_(box, core),
      last_(at_rest_in(core)),
      reacquisition_(config, last_, frame.time_s) {
  filter_.particles().assign(static_cast<std::size_t>(config.particles), last_);
  belief_.start();
}

TrackerOutput TrackerCore::step(const TrackerInput& frame, StageTimer& timer) {
  const EgoMotion ego_motion = move_camera(frame, timer);
  if (target_.empty()) designate_late(frame);
  reacquisition_.predict(motion_, scene_motion_, placed_);
  recognition_.advance(motion_, scene_motion_.frame_size());
  const bool recognised = recognise(frame);
  timer.lap(Stage::kRecognition);
  if (!recognised) predict(ego_motion, timer);
  TrackerOutput output = recognised ? follow(frame, timer) : update(frame, timer);
  output.ego_motion = ego_motion;
  after_update(output);
  if (!target_.empty()) {
    recognition_.judge(frame, scene_motion_.references(), last_, motion_.interval_s());
  }
  output.belief *= recognition_.belief();
  if (recognised) recognition_.remember(last_, scene_motion_.time_s());
  if (const auto sure = recognition_.return_to_sure(frame, scene_motion_.references(), last_)) {
    last_ = *sure;
    target_.restart_size(last_.size_px);
    filter_.restart(last_);
    reacquisition_.see(last_);
  }
  scene_motion_.remember(frame.gray, box_of(last_.pixel, last_.size_px));
  filter_.resample(random_);
  filter_.propose_size(last_.size_px, target_.usual_size_px());
  placed_ = false;
  timer.lap(Stage::kLearning);
  return output;
}

void TrackerCore::search_near(const Eigen::Vector2d& designated, double sd_px) {
  const Eigen::Vector2d& size_px = reacquisition_.believed().size_px;
  const Eigen::Vector2d pixel = designated - designation_.place().cwiseProduct(size_px);
  for (Particle& particle : filter_.particles()) {
    particle = reacquisition_.drawn_near(pixel, sd_px, random_);
  }
  reacquisition_.start_near(pixel, sd_px);
  last_.pixel = pixel;
  last_.size_px = size_px;
  belief_.doubt();
  recognition_.restart();
  measurement_.restart();
  placed_ = true;
}

EgoMotion TrackerCore::move_camera(const TrackerInput& frame, StageTimer& timer) {
  const EgoMotion source = scene_motion_.advance(frame, box_of(last_.pixel, last_.size_px), timer);
  other_step_px_.reset();
  if (image_motion() && frame.predicted_homography) {
    const Eigen::Vector2d apart = transform(*frame.predicted_homography, last_.pixel) -
                                  transform(image_motion()->homography, last_.pixel);
    if (apart.norm() > kAgree * motion_.position_sd(last_.size_px)) other_step_px_ = apart;
  }
  const CameraMotion motion{scene_motion_.homography(), scene_motion_.interval_s()};
  const Eigen::Vector2d change_px_s = motion_.begin_frame(motion, last_.pixel);
  for (Particle& particle : filter_.particles()) particle.velocity_px_s += change_px_s;
  if (velocity_ == Velocity::kEstimated) {  // a new target has no velocity yet
    last_.velocity_px_s += change_px_s;
    reacquisition_.change_velocity(change_px_s);
  }
  return source;
}

void TrackerCore::designate_late(const TrackerInput& frame) {
  const auto core = designation_.find_late(frame.gray, motion_);
  if (!core) return;
  target_ = TargetModel(config_, frame.gray, *core);
  recognition_ = Recognition(frame, centre_of(*core), size_of(*core));
  measurement_.restart();
  last_ = at_rest_in(*core);
  reacquisition_.restart(last_);
  filter_.particles().assign(filter_.particles().size(), last_);
  velocity_ = Velocity::kUnknown;
  placed_ = true;
}

// The learnt appearance, where the target is expected: moves `last_` there if it is found.
bool TrackerCore::recognise(const TrackerInput& frame) {
  if (target_.empty()) return false;
  const bool searching = reacquisition_.searching();
  const bool known = velocity_ == Velocity::kEstimated;
  const Eigen::Vector2d expected = known ? expected_px() : unmoved_px();
  std::vector<Eigen::Vector2d> places{expected};
  if (other_step_px_) places.push_back(expected + *other_step_px_);
  const Particle& believed = reacquisition_.believed();
  if (searching) places.push_back(believed.pixel);
  const auto found = recognition_.appearance().find(frame, places, target_.usual_size_px(),
                                                    searching ? kFoundAgain : kFollowed);
  if (!found || !reacquisition_.may_be_target({*found, {0.0, 0.0}, last_.size_px})) return false;
  constexpr double kGain = 0.5;  // of an alpha-beta filter for the velocity
  Eigen::Vector2d moved_px = *found - unmoved_px();
  const bool by_other =
      other_step_px_ && (*found - expected - *other_step_px_).norm() < (*found - expected).norm();
  if (by_other) moved_px -= *other_step_px_;
  const Eigen::Vector2d velocity_px_s = moved_px / motion_.interval_s();
  if (searching) {  // it has leapt from where something else was: its former velocity is better
    last_.velocity_px_s = believed.velocity_px_s;
  } else {
    if (!known) last_.velocity_px_s.setZero();
    last_.velocity_px_s += kGain * (velocity_px_s - last_.velocity_px_s);
  }
  last_ =
      bounded({*found, last_.velocity_px_s, target_.usual_size_px()}, scene_motion_.frame_size());
  return true;
}

void TrackerCore::predict(EgoMotion ego_motion, StageTimer& timer) {
  if (placed_ || velocity_ == Velocity::kUnknown)
    filter_.guess_velocities(motion_, config_.initial_velocity_sd_px_s, random_);
  if (!placed_) filter_.advance(motion_);
  filter_.disturb(motion_, random_);
  // Image and mount report different motions: dirt on the lens and burnt-in text are stationary in
  // the image, a slipped gear in the mount. The target's appearance decides.
  if (other_step_px_) filter_.move_half(*other_step_px_);
  timer.lap(Stage::kPrediction);
  propose(ego_motion);
  timer.lap(Stage::kProposals);
  for (Particle& particle : filter_.particles()) {
    particle = bounded(particle, scene_motion_.frame_size());
  }
  if (velocity_ == Velocity::kUnknown) {
    filter_.widen_prediction(config_.leap_most_px_s * motion_.interval_s() / 3.0);
  }
  timer.lap(Stage::kPrediction);
}

// Particles where the motion model alone would hardly place them.
void TrackerCore::propose(EgoMotion ego_motion) {
  const bool searching = reacquisition_.searching();
  auto& particles = filter_.particles();
  if (searching) reacquisition_.scatter(particles, random_);
  if (ego_motion == EgoMotion::kNone) {
    force_onto_differences({{0.0, 0.0}, cv::Size2d(scene_motion_.frame_size())});
  } else if (searching || velocity_ == Velocity::kUnknown) {
    force_onto_differences(reachable_area());
  }
  if (searching && !target_.empty()) {
    reacquisition_.look_for_movers(scene_motion_, last_.size_px);
    reacquisition_.force_onto_movers(particles, random_);
  }
}

// The target's expected place in this frame.
Eigen::Vector2d TrackerCore::expected_px() const {
  return placed_ ? last_.pixel : motion_.advance(last_).pixel;
}

// Its place in this frame if it had not moved relative to the scene.
Eigen::Vector2d TrackerCore::unmoved_px() const {
  return placed_ ? last_.pixel - last_.velocity_px_s * motion_.interval_s()
                 : motion_.still(last_.pixel);
}

// Where a target of unknown velocity can be.
cv::Rect2d TrackerCore::reachable_area() const {
  const auto& region = reacquisition_.region();
  const Eigen::Vector2d centre = region ? region->pixel : unmoved_px();
  const double reach =
      config_.leap_most_px_s * motion_.interval_s() + (region ? 2.0 * region->sd_px : 0.0);
  return box_of(centre, last_.size_px + Eigen::Vector2d::Constant(2.0 * reach));
}

void TrackerCore::force_onto_differences(const cv::Rect2d& area) {
  constexpr int kMaxima = 5;
  const bool moves_unknown = reacquisition_.searching() || velocity_ == Velocity::kUnknown;
  const auto maxima = difference_candidates(scene_motion_.previous(), scene_motion_.present(),
                                            motion_.homography(), area, last_.size_px, kMaxima);
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
    // The leap since the last frame gives the velocity, if the target was there then.
    if (moves_unknown && random_.uniform() < 0.5) {
      particle.velocity_px_s = (particle.pixel - unmoved_px()) / motion_.interval_s();
    }
  }
}

// A target that its learnt appearance places needs no particles: they wait around it. Where it
// looks as it did at first, that image measures the place.
TrackerOutput TrackerCore::follow(const TrackerInput& frame, StageTimer& timer) {
  constexpr double kSameImage = 0.85;  // correlation with the first image
  constexpr double kSamePlace = 0.9;   // of the response
  velocity_ = Velocity::kEstimated;
  filter_.restart(last_);
  const cv::Rect2d box = box_of(last_.pixel, last_.size_px);
  const Scene scene =
      target_.make_scene(frame.gray, filter_.particles(), box, scene_motion_.references());
  timer.lap(Stage::kMasks);
  const double recognised = recognition_.appearance().recognised(last_.pixel);
  auto placed = target_.place(scene, last_.pixel, last_.size_px);
  const bool same = placed && placed->correlation > kSameImage &&
                    recognition_.appearance().recognised(placed->centre) >= kSamePlace * recognised;
  if (!same) placed.reset();
  TrackerOutput output = locate(scene, placed);
  timer.lap(Stage::kPosition);
  FrameEvidence evidence = target_.evidence(scene, last_);
  evidence.recognised = recognised;
  belief_.update(evidence, motion_.interval_s());
  reacquisition_.identify(last_, scene, target_, belief_);
  if (recognised > kLearnt && !recognition_.doubts()) {
    learn(scene);
    const double interval_s = motion_.interval_s();
    last_.size_px = target_.follow_size(frame.gray, last_, measurement_.size_px(), interval_s);
    recognition_.appearance().learn(frame, last_.pixel, target_.usual_size_px(), interval_s);
  }
  output.box = designation_.box(last_);
  output.belief = reacquisition_.identity() * belief_.value();
  return output;
}

TrackerOutput TrackerCore::update(const TrackerInput& frame, StageTimer& timer) {
  const cv::Rect2d expected = box_of(expected_px(), last_.size_px);
  const Eigen::Vector2d unmoved = unmoved_px();
  Scene scene =
      target_.make_scene(frame.gray, filter_.particles(), expected, scene_motion_.references());
  timer.lap(Stage::kMasks);
  scene.background_similarity = target_.background_similarity(scene, expected);
  weigh_particles(scene);
  const std::size_t best = choose(scene);
  last_ = filter_.particles()[best];
  last_.size_px = filter_.mean_size_px();
  timer.lap(Stage::kWeighting);
  auto placed = target_.place(scene, last_.pixel, last_.size_px);
  if (placed && placed->correlation <= kSamePattern) placed.reset();
  TrackerOutput output = locate(scene, placed);
  reacquisition_.learn_velocity(placed.has_value(), unmoved, motion_.interval_s(), last_);
  filter_.particles()[best].pixel = last_.pixel;
  timer.lap(Stage::kPosition);
  judge(scene);
  learn(scene);
  output.box = designation_.box(last_);
  output.belief = reacquisition_.identity() * belief_.value();
  return output;
}

void TrackerCore::weigh_particles(const Scene& scene) {
  constexpr double kStill = 5.0;  // reduces the log-likelihood
  filter_.weigh([&](const Particle& particle) {
    const Similarity likeness = target_.likeness(scene, particle.pixel, particle.size_px);
    const double out = target_.standing_out(scene, particle.pixel, particle.size_px);
    const double alike =
        target_.log_likelihood(likeness, scene.background_similarity, out, particle.size_px);
    return reacquisition_.may_be_target(particle) ? alike : alike - kStill;
  });
}

// A bird next to the target may look more like it in this frame than the target does: if the
// candidate at the expected place can be believed, none beyond its reach is chosen.
std::size_t TrackerCore::choose(const Scene& scene) const {
  const auto& particles = filter_.particles();
  const auto& log_likelihood = filter_.log_likelihood();
  const std::size_t best = filter_.maximum_a_posteriori();
  if (!followed() || !beyond_reach(particles[best].pixel)) return best;
  std::optional<std::size_t> near;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (beyond_reach(particles[i].pixel)) continue;
    if (!near || log_likelihood[i] > log_likelihood[*near]) near = i;
  }
  if (!near) return best;
  const FrameEvidence there = target_.evidence(scene, particles[*near]);
  return belief_.in_frame(there) >= kBelieved ? *near : best;
}

// The designated point, where the target is placed, and its covariance.
TrackerOutput TrackerCore::locate(const Scene& scene,
                                  const std::optional<RefinedPosition>& placed) {
  TrackerOutput output;
  if (placed) {
    last_.pixel = placed->centre;
    const MeasuredPoint point = measurement_.measure(target_, scene, *placed, last_.size_px,
                                                     designation_.place(), motion_.interval_s());
    output.pixel = point.pixel;
    output.covariance_px2 = point.covariance_px2;
  } else {
    measurement_.miss();
    output.pixel = designation_.point(last_);
    output.covariance_px2 = filter_.covariance_about(last_.pixel);
    output.covariance_px2.diagonal() += (kNotPlaced * last_.size_px).cwiseAbs2();
  }
  output.covariance_px2.diagonal().array() += config_.pixel_sd_floor_px * config_.pixel_sd_floor_px;
  return output;
}

// The belief in the chosen candidate.
void TrackerCore::judge(const Scene& scene) {
  const FrameEvidence evidence = target_.evidence(scene, last_);
  belief_.update(evidence, motion_.interval_s());
  // A new object in a known scene is as good as a mover.
  const bool is_new = evidence.by_subtraction && evidence.foreground > 0.5;
  const bool cut = scene_motion_.unknown_a_moment_ago() ||
                   (!reacquisition_.searching() && scene_motion_.may_be_cut());
  const bool told_by_look = cut && belief_.usual(evidence);
  const bool leapt = followed() && beyond_reach(last_.pixel) && !told_by_look;
  if (leapt) reacquisition_.start(reach_px());
  velocity_ = Velocity::kEstimated;
  const bool elsewhere = !reacquisition_.may_be_target(last_) && !is_new && !told_by_look;
  if (target_.empty() || leapt || elsewhere) belief_.doubt();
  reacquisition_.identify(last_, scene, target_, belief_);
}

void TrackerCore::learn(const Scene& scene) {
  if (belief_.value() > kSureEnoughForMask) target_.learn_mask(scene, last_.pixel, last_.size_px);
  if (belief_.value() <= kSureEnoughToLearn) return;
  const double share = 1.0 - std::exp(-motion_.interval_s() / config_.learning_time_s);
  target_.learn(scene, last_.pixel, last_.size_px, share);
  if (measurement_.size_px()) target_.learn_size(*measurement_.size_px(), share);
}

void TrackerCore::after_update(const TrackerOutput& output) {
  const bool believed = output.belief >= kBelieved;
  // A frame that shows another object says nothing about the target's place, however high the
  // belief was.
  if (belief_.of_frame() >= kBelieved && believed) {
    reacquisition_.see({last_.pixel, filter_.mean_velocity_px_s(), last_.size_px});
  }
  if (believed) {
    reacquisition_.end();
  } else if (!reacquisition_.searching()) {
    reacquisition_.start(reach_px());
  }
}

// How far a followed target can be from its prediction.
double TrackerCore::reach_px() const {
  return 2.0 * motion_.position_sd(last_.size_px) +
         config_.search_growth_px_s * motion_.interval_s();
}

// Further from the expected place than the target can have moved: a cut, or another object.
bool TrackerCore::beyond_reach(const Eigen::Vector2d& pixel) const {
  const double most_px = 2.0 * reach_px() + last_.size_px.norm();
  const Eigen::Vector2d off_px = pixel - reacquisition_.believed().pixel;
  const bool by_other = other_step_px_ && (off_px - *other_step_px_).norm() <= most_px;
  return off_px.norm() > most_px && !by_other;
}

bool TrackerCore::followed() const {
  return !reacquisition_.searching() && velocity_ == Velocity::kEstimated;
}

}  // namespace ols::tracker
