#include "edge/tracker/paper_tracker.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "edge/tracker/difference_candidates.h"
#include "edge/tracker/motion_model.h"
#include "edge/tracker/objective.h"

namespace ols {
namespace {

// The whole frame: the paper's patches are sampled from the image itself.
FrameView whole(const cv::Mat& gray) { return {gray, {0, 0}, 1}; }

cv::Rect enclosing(const cv::Rect2d& box) {
  return {static_cast<int>(std::floor(box.x)), static_cast<int>(std::floor(box.y)),
          static_cast<int>(std::ceil(box.width)) + 1, static_cast<int>(std::ceil(box.height)) + 1};
}

cv::Rect area_of(const std::vector<Particle>& particles) {
  cv::Rect2d area = box_of(particles.front().pixel, particles.front().size_px);
  for (const Particle& particle : particles) area |= box_of(particle.pixel, particle.size_px);
  return enclosing(area);
}

}  // namespace

double paper_objective(const Patch& template_gray, const MaskPatch& template_mask,
                       const Patch& candidate_gray, const MaskPatch& candidate_mask) {
  const auto& exponential = exponentials<double>();
  double sum = 0.0;
  for (std::size_t i = 0; i < kPatchArea; ++i) {
    const double alike =
        1.0 - std::abs(static_cast<double>(template_gray[i] - candidate_gray[i])) / 255.0;
    sum += exponential[std::min(template_mask[i], candidate_mask[i])] * alike * alike;  // eq. (5)
  }
  return sum;
}

// "The target is represented as a rectangular template (consisting of gray-scale intensity values),
// which is normalized to the size 24x24 pixels." "The template is created only once during the
// initialization."
PaperTracker::PaperTracker(const TrackerConfig& config, std::uint64_t seed,
                           const TrackerInput& frame, const cv::Rect2d& box)
    : config_(config),
      random_(seed),
      ego_motion_(config),
      reduced_(reduce_frame(frame.gray, config.ego_motion_width_px)),
      references_(config.reference_interval_s),
      first_{frame.gray.clone(), Eigen::Matrix3d::Identity(), box, frame.time_s},
      template_(make_template(whole(frame.gray), centre_of(box), size_of(box))),
      frame_size_(frame.gray.size()),
      time_s_(frame.time_s) {
  last_.pixel = centre_of(box);
  last_.size_px = size_of(box);
  particles_.assign(static_cast<std::size_t>(config.particles), last_);
  for (Particle& particle : particles_) {
    particle.velocity_px_s = noise(config.initial_velocity_sd_px_s);
  }
  ego_motion_.start(reduced_);
  references_.offer(frame.gray, frame.time_s, box);
}

TrackerOutput PaperTracker::step(const TrackerInput& frame, StageTimer& timer) {
  const double interval_s = usable_interval_s(time_s_, frame.time_s);
  time_s_ = frame.time_s;
  const ReducedFrame reduced = reduce_frame(frame.gray, config_.ego_motion_width_px);
  timer.lap(Stage::kReduction);
  const EgoMotion ego_motion = transform_by_homography(reduced);
  timer.lap(Stage::kEgoMotion);
  predict(interval_s);
  timer.lap(Stage::kPrediction);
  if (!homography_) force_subset_onto_differences(reduced);
  timer.lap(Stage::kProposals);
  weigh(frame.gray);
  timer.lap(Stage::kWeighting);
  last_ = maximum_a_posteriori();
  TrackerOutput output = output_of(last_);
  output.ego_motion = ego_motion;
  estimate_template_mask(frame.gray, output.box);
  references_.offer(frame.gray, frame.time_s, output.box);
  reduced_ = reduced;
  resample();
  timer.lap(Stage::kLearning);
  return output;
}

// "In order to enable the motion of the camera, the transformation between each pair of adjacent
// frames is estimated by detecting and tracking the keypoints using KLT tracker and then estimating
// the homography using the RANSAC algorithm."
EgoMotion PaperTracker::transform_by_homography(const ReducedFrame& reduced) {
  const auto estimate = ego_motion_.step(reduced, box_of(last_.pixel, last_.size_px), std::nullopt);
  homography_ = estimate.homography;
  if (!homography_) {
    if (!estimate.featureless) {  // nothing aligns them any more
      references_.clear();
      first_.gray.release();
    }
    return EgoMotion::kNone;
  }
  if (!placed_) {
    for (Particle& particle : particles_) {
      particle.pixel = transform(*homography_, particle.pixel);
    }
  }
  references_.advance(*homography_);
  first_.to_present = *homography_ * first_.to_present;
  return EgoMotion::kImage;
}

// "The motion model which is applied in the prediction step of the BPF", eq. (2)-(4); each gamma is
// drawn from N(0, sigma), "set empirically for each parameter".
void PaperTracker::predict(double interval_s) {
  const double moving_s = placed_ ? 0.0 : interval_s;
  placed_ = false;
  for (Particle& p : particles_) {
    p.pixel += p.velocity_px_s * moving_s + noise(config_.paper.position_sd_px);  // (2)
    p.velocity_px_s += noise(config_.paper.velocity_sd_px_s);                     // (3)
    p.size_px += noise(config_.paper.size_sd_px);                                 // (4)
    p = bounded(p, frame_size_);
  }
}

// "The homography might not be found [...] To deal with such cases in OLS, the tracker was adjusted
// so that in a prediction step of the BPF a small subset of particles would be forced to take the
// image positions yielding the highest response of adjacent frame differencing."
void PaperTracker::force_subset_onto_differences(const ReducedFrame& reduced) {
  constexpr int kMaxima = 5;
  const cv::Rect2d everywhere(0.0, 0.0, reduced.image.cols * reduced.reduction,
                              reduced.image.rows * reduced.reduction);
  const auto maxima =
      difference_candidates(reduced_, reduced, std::nullopt, everywhere, last_.size_px, kMaxima);
  if (maxima.empty()) return;
  const auto count = static_cast<std::size_t>(config_.difference_fraction *
                                              static_cast<double>(particles_.size()));
  for (std::size_t i = 0; i < count; ++i) {
    particles_[i * particles_.size() / count].pixel = maxima[i % maxima.size()];
  }
}

// "In the update step, each particle is assigned a new weight w using the objective function
// reflecting the similarity of the template and the candidate patch." "The FMs are estimated by
// subtraction of the two images where the bounding boxes denoting the position of the target do not
// overlap." Until there are two such images no pixel counts as foreground.
void PaperTracker::weigh(const cv::Mat& gray) {
  FrameView mask;
  const auto* reference = references_.without_overlap(box_of(last_.pixel, last_.size_px));
  if (reference) mask = foreground_mask(gray, *reference, area_of(particles_), template_);
  const FrameView view = whole(gray);
  const MaskPatch nothing{};
  weights_.resize(particles_.size());
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    const Particle& p = particles_[i];
    const bool inside = p.pixel.x() > -0.5 && p.pixel.y() > -0.5 && p.pixel.x() < gray.cols - 0.5 &&
                        p.pixel.y() < gray.rows - 0.5;
    const MaskPatch candidate_mask = reference ? sample_mask(mask, p.pixel, p.size_px) : nothing;
    weights_[i] = inside ? paper_objective(template_.gray, template_mask_.value_or(nothing),
                                           sample_patch(view, p.pixel, p.size_px), candidate_mask)
                         : 0.0;
  }
  normalise_weights();
}

// To a sum of one, sharpened: see PaperTrackerConfig::weight_power. All alike where none is any.
void PaperTracker::normalise_weights() {
  greatest_objective_ = *std::max_element(weights_.begin(), weights_.end());
  double sum = 0.0;
  for (double& weight : weights_) {
    const double share = greatest_objective_ > 0.0 ? weight / greatest_objective_ : 1.0;
    weight = std::pow(share, config_.paper.weight_power);
    sum += weight;
  }
  for (double& weight : weights_) weight /= sum;
}

// "The FM Mt is estimated only once": the template's frame less the first later one in which the
// target has left its box.
void PaperTracker::estimate_template_mask(const cv::Mat& gray, const cv::Rect2d& box) {
  if (template_mask_) return;
  if (first_.gray.empty() || !aligns(first_.to_present)) {
    // The camera's way from the template's frame is lost: what it takes begins anew.
    first_ = {gray.clone(), Eigen::Matrix3d::Identity(), box, time_s_};
    return;
  }
  const Eigen::Matrix3d to_first = first_.to_present.inverse();
  const cv::Rect2d there = box_of(transform(to_first, last_.pixel), last_.size_px);
  if ((there & first_.target_box).area() > 0.0) return;
  const ReferenceFrames::Reference present{gray, to_first, {}, time_s_};
  const FrameView mask =
      foreground_mask(first_.gray, present, enclosing(first_.target_box), template_);
  template_mask_ = sample_mask(mask, centre_of(first_.target_box), size_of(first_.target_box));
  first_.gray.release();
}

// "The resulting estimate of the target position is chosen using the Maximum a posteriori
// approach": resampled particles are equally probable before the update, so it is the greatest
// weight.
const Particle& PaperTracker::maximum_a_posteriori() const {
  const auto best = std::max_element(weights_.begin(), weights_.end());
  return particles_[static_cast<std::size_t>(best - weights_.begin())];
}

// The paper's tracker has a belief but no formula of it: eq. (5) by the greatest value that it can
// take.
TrackerOutput PaperTracker::output_of(const Particle& best) const {
  double greatest = kPatchArea;
  if (template_mask_) {
    greatest = 0.0;
    for (const std::uint8_t mask : *template_mask_) greatest += exponentials<double>()[mask];
  }
  TrackerOutput output;
  output.box = box_of(best.pixel, best.size_px);
  output.pixel = best.pixel;
  output.belief = std::clamp(greatest_objective_ / greatest, 0.0, 1.0);
  const double variance = std::pow(config_.pixel_sd_floor_px, 2);
  output.covariance_px2 = variance * Eigen::Matrix2d::Identity();
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    const Eigen::Vector2d off = particles_[i].pixel - best.pixel;
    output.covariance_px2 += weights_[i] * off * off.transpose();
  }
  return output;
}

// "The Bootstrap particle filter (BPF) - the variant of a particle filter following the sequential
// importance sampling approach." Systematic resampling.
void PaperTracker::resample() {
  const double step = 1.0 / static_cast<double>(particles_.size());
  double at = random_.uniform() * step;
  double reached = weights_.front();
  std::size_t source = 0;
  resampled_.clear();
  for (std::size_t i = 0; i < particles_.size(); ++i, at += step) {
    while (at > reached && source + 1 < particles_.size()) reached += weights_[++source];
    resampled_.push_back(particles_[source]);
  }
  particles_.swap(resampled_);
}

void PaperTracker::search_near(const Eigen::Vector2d& pixel, double sd_px) {
  for (Particle& particle : particles_) {
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

}  // namespace ols
