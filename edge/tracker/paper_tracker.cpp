#include "edge/tracker/paper_tracker.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "edge/tracker/difference_candidates.h"
#include "edge/tracker/motion_model.h"

namespace ols::tracker {
namespace {

cv::Rect area_of(const std::vector<Particle>& particles) {
  cv::Rect2d area = box_of(particles.front().pixel, particles.front().size_px);
  for (const Particle& particle : particles) area |= box_of(particle.pixel, particle.size_px);
  return enclosing(area);
}

}  // namespace

PaperTracker::PaperTracker(const TrackerConfig& config, std::uint64_t seed,
                           const TrackerInput& frame, const cv::Rect2d& box)
    : config_(config),
      random_(seed),
      scene_motion_(config, HomographyFit::kRansac, frame, box),
      template_(frame, box) {
  last_.pixel = centre_of(box);
  last_.size_px = size_of(box);
  filter_.particles().assign(static_cast<std::size_t>(config.particles), last_);
  for (Particle& particle : filter_.particles()) {
    particle.velocity_px_s = noise(config_.initial_velocity_sd_px_s);
  }
}

TrackerOutput PaperTracker::step(const TrackerInput& frame, StageTimer& timer) {
  const EgoMotion ego_motion = transform_by_homography(frame, timer);
  predict();
  timer.lap(Stage::kPrediction);
  if (ego_motion == EgoMotion::kNone) force_subset_onto_differences();
  timer.lap(Stage::kProposals);
  weigh(frame.gray);
  timer.lap(Stage::kWeighting);
  last_ = maximum_a_posteriori();
  TrackerOutput output = output_of(last_);
  output.ego_motion = ego_motion;
  template_.estimate_mask(frame.gray, frame.time_s, last_);
  scene_motion_.remember(frame.gray, output.box);
  filter_.resample(random_);
  timer.lap(Stage::kLearning);
  return output;
}

// "In order to enable the motion of the camera, the transformation between each pair of adjacent
// frames is estimated by detecting and tracking the keypoints using KLT tracker and then estimating
// the homography using the RANSAC algorithm."
EgoMotion PaperTracker::transform_by_homography(const TrackerInput& frame, StageTimer& timer) {
  const TrackerInput unpredicted{frame.gray, frame.time_s, std::nullopt};
  const cv::Rect2d box = box_of(last_.pixel, last_.size_px);
  const EgoMotion ego_motion = scene_motion_.advance(unpredicted, box, timer);
  const auto& homography = scene_motion_.homography();
  if (homography && !placed_) {
    for (Particle& particle : filter_.particles()) {
      particle.pixel = transform(*homography, particle.pixel);
    }
  }
  template_.follow(scene_motion_);
  return ego_motion;
}

// "The motion model which is applied in the prediction step of the BPF", eq. (2)-(4); each gamma is
// drawn from N(0, sigma), "set empirically for each parameter".
void PaperTracker::predict() {
  const double moving_s = placed_ ? 0.0 : scene_motion_.interval_s();
  placed_ = false;
  for (Particle& p : filter_.particles()) {
    p.pixel += p.velocity_px_s * moving_s + noise(config_.paper.position_sd_px);  // (2)
    p.velocity_px_s += noise(config_.paper.velocity_sd_px_s);                     // (3)
    p.size_px += noise(config_.paper.size_sd_px);                                 // (4)
    p = bounded(p, scene_motion_.frame_size());
  }
}

// "The homography might not be found [...] To deal with such cases in OLS, the tracker was adjusted
// so that in a prediction step of the BPF a small subset of particles would be forced to take the
// image positions yielding the highest response of adjacent frame differencing."
void PaperTracker::force_subset_onto_differences() {
  constexpr int kMaxima = 5;
  const ReducedFrame& present = scene_motion_.present();
  const cv::Rect2d everywhere(0.0, 0.0, present.image.cols * present.reduction,
                              present.image.rows * present.reduction);
  const auto maxima = difference_candidates(scene_motion_.previous(), present, std::nullopt,
                                            everywhere, last_.size_px, kMaxima);
  if (maxima.empty()) return;
  auto& particles = filter_.particles();
  const auto count =
      static_cast<std::size_t>(config_.difference_fraction * static_cast<double>(particles.size()));
  for (std::size_t i = 0; i < count; ++i) {
    particles[i * particles.size() / count].pixel = maxima[i % maxima.size()];
  }
}

// "In the update step, each particle is assigned a new weight w using the objective function
// reflecting the similarity of the template and the candidate patch." "The FMs are estimated by
// subtraction of the two images where the bounding boxes denoting the position of the target do not
// overlap." Until there are two such images no pixel counts as foreground.
void PaperTracker::weigh(const cv::Mat& gray) {
  const auto& particles = filter_.particles();
  FrameView mask;
  const auto* reference =
      scene_motion_.references().without_overlap(box_of(last_.pixel, last_.size_px));
  if (reference) {
    mask = foreground_mask(gray, *reference, area_of(particles), template_.appearance());
  }
  const FrameView view = whole(gray);
  std::vector<double> objective;
  objective.reserve(particles.size());
  for (const Particle& p : particles) {
    const bool inside = p.pixel.x() > -0.5 && p.pixel.y() > -0.5 && p.pixel.x() < gray.cols - 0.5 &&
                        p.pixel.y() < gray.rows - 0.5;
    const MaskPatch candidate = reference ? sample_mask(mask, p.pixel, p.size_px) : MaskPatch{};
    objective.push_back(
        inside ? template_.objective(sample_patch(view, p.pixel, p.size_px), candidate) : 0.0);
  }
  filter_.set_weights(normalised(std::move(objective)));
}

// Normalised and sharpened: see PaperTrackerConfig::weight_power. Equal if all are zero.
std::vector<double> PaperTracker::normalised(std::vector<double> weights) {
  greatest_objective_ = *std::max_element(weights.begin(), weights.end());
  double sum = 0.0;
  for (double& weight : weights) {
    const double share = greatest_objective_ > 0.0 ? weight / greatest_objective_ : 1.0;
    weight = std::pow(share, config_.paper.weight_power);
    sum += weight;
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

// "The resulting estimate of the target position is chosen using the Maximum a posteriori
// approach": resampled particles are equally probable before the update, so it is the largest
// weight.
const Particle& PaperTracker::maximum_a_posteriori() const {
  const auto& weights = filter_.weights();
  const auto best = std::max_element(weights.begin(), weights.end());
  return filter_.particles()[static_cast<std::size_t>(best - weights.begin())];
}

// The paper's tracker has a belief but no formula for it: eq. (5) divided by its maximum.
TrackerOutput PaperTracker::output_of(const Particle& best) const {
  TrackerOutput output;
  output.box = box_of(best.pixel, best.size_px);
  output.pixel = best.pixel;
  output.belief = std::clamp(greatest_objective_ / template_.greatest_objective(), 0.0, 1.0);
  const double variance = std::pow(config_.pixel_sd_floor_px, 2);
  output.covariance_px2 = variance * Eigen::Matrix2d::Identity();
  for (std::size_t i = 0; i < filter_.particles().size(); ++i) {
    const Eigen::Vector2d off = filter_.particles()[i].pixel - best.pixel;
    output.covariance_px2 += filter_.weights()[i] * off * off.transpose();
  }
  return output;
}

void PaperTracker::search_near(const Eigen::Vector2d& pixel, double sd_px) {
  for (Particle& particle : filter_.particles()) {
    particle.pixel = pixel + noise(sd_px);
    particle.velocity_px_s = noise(config_.initial_velocity_sd_px_s);
    particle.size_px = last_.size_px;
  }
  last_.pixel = pixel;
  placed_ = true;
}

Eigen::Vector2d PaperTracker::noise(double sd) {
  const double x = random_.gaussian();
  const double y = random_.gaussian();
  return {sd * x, sd * y};
}

}  // namespace ols::tracker
