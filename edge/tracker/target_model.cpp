#include "edge/tracker/target_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ols::tracker {
namespace {

cv::Rect widened(const cv::Rect2d& box, double sides) {
  const double x = sides * box.width;
  const double y = sides * box.height;
  return {static_cast<int>(std::floor(box.x - x)), static_cast<int>(std::floor(box.y - y)),
          static_cast<int>(std::ceil(box.width + 2.0 * x)) + 1,
          static_cast<int>(std::ceil(box.height + 2.0 * y)) + 1};
}

// The part of the frame used by the particles and the background's samples.
cv::Rect looked_at(const std::vector<Particle>& particles, const cv::Rect2d& expected) {
  cv::Rect2d area = widened(expected, 3.0);
  for (const Particle& particle : particles) area |= box_of(particle.pixel, particle.size_px);
  return widened(area, 0.0);
}

Template smooth_template(Template made, const FrameView& view, const cv::Rect2d& box) {
  const FrameView smooth = smoothed(view, widened(box, 0.5), size_of(box));
  made.gray = sample_patch(smooth, centre_of(box), size_of(box));
  return made;
}

}  // namespace

TargetModel::TargetModel(const TrackerConfig& config, const cv::Mat& gray, const cv::Rect2d& box)
    : TargetModel(config, make_view(gray, widened(box, 3.0), reduction_for(size_of(box))), box) {
  // M_t until an earlier image shows the background alone.
  const Scene scene = make_scene(gray, {}, box, ReferenceFrames(config.reference_interval_s));
  mask_ = sample_mask(scene.mask, centre_of(box), size_of(box));
  objective_.set_mask(mask_);
  set_contrast(scene.contrast(centre_of(box), size_of(box)));
  if (scene.view.reduction > 1) {
    fine_refiner_.emplace(scene.whole, centre_of(box), size_of(box));
  }
}

void TargetModel::set_contrast(double contrast) {
  contrast_ = contrast;
  const double noise = 1.0 + static_cast<double>(template_.noise);
  contrast_weight_ = contrast * contrast / (contrast * contrast + noise * noise);
}

TargetModel::TargetModel(const TrackerConfig& config, const FrameView& view, const cv::Rect2d& box)
    : config_(config),
      first_size_px_(size_of(box)),
      usual_size_px_(first_size_px_),
      template_(make_template(view, centre_of(box), size_of(box))),
      objective_(smooth_template(template_, view, box)),
      refiner_(view, centre_of(box), size_of(box)) {}

Scene TargetModel::make_scene(const cv::Mat& gray, const std::vector<Particle>& particles,
                              const cv::Rect2d& expected, const ReferenceFrames& references) const {
  const cv::Rect area = looked_at(particles, expected);
  Scene scene;
  scene.frame = gray.size();
  scene.whole = {gray, {0, 0}, 1};
  scene.view = make_view(gray, area, reduction_for(first_size_px_));
  scene.smooth = smoothed(scene.view, area, first_size_px_);
  scene.contrast = LocalContrast(scene.view, widened(area, 0.4));
  if (const auto* reference = references.without_overlap(expected)) {
    scene.mask = foreground_mask(gray, *reference, area, template_);
    scene.mask_by_subtraction = true;
  } else {
    const float level = level_around(scene.view, centre_of(expected), size_of(expected));
    scene.mask = foreground_mask(gray, static_cast<double>(level), area, template_);
  }
  return scene;
}

Similarity TargetModel::likeness(const Scene& scene, const Eigen::Vector2d& pixel,
                                 const Eigen::Vector2d& size_px) const {
  const bool seen = pixel.x() > -0.5 && pixel.y() > -0.5 && pixel.x() < scene.frame.width - 0.5 &&
                    pixel.y() < scene.frame.height - 0.5;
  if (!seen) return {};
  const MaskPatch mask = sample_mask(scene.mask, pixel, size_px);
  return objective_(sample_patch(scene.smooth, pixel, size_px), mask);
}

double TargetModel::background_similarity(const Scene& scene, const cv::Rect2d& box) const {
  constexpr int kDirections = 12;
  std::vector<double> reached;
  for (int i = 0; i < 2 * kDirections; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kDirections;
    const double far = i < kDirections ? 1.5 : 2.3;
    const Eigen::Vector2d off(far * box.width * std::cos(angle),
                              far * box.height * std::sin(angle));
    reached.push_back(likeness(scene, centre_of(box) + off, size_of(box)).similarity);
  }
  const auto high = reached.begin() + static_cast<std::ptrdiff_t>(reached.size() * 3 / 4);
  std::nth_element(reached.begin(), high, reached.end());
  return *high;
}

double TargetModel::standing_out(const Scene& scene, const Eigen::Vector2d& pixel,
                                 const Eigen::Vector2d& size_px) const {
  if (std::abs(contrast_) < 0.1) return 0.0;
  // Darker instead of brighter, or the reverse, as the background changes: equally similar, but
  // rarer.
  constexpr double kInverted = 0.9;
  const double ratio = scene.contrast(pixel, size_px) / contrast_;
  return std::min(2.0, ratio < 0.0 ? -kInverted * ratio : ratio);
}

double TargetModel::foreground(const Scene& scene, const Eigen::Vector2d& pixel,
                               const Eigen::Vector2d& size_px) const {
  const MaskPatch now = sample_mask(scene.mask, pixel, size_px);
  int common = 0, all = 0;
  for (std::size_t i = 0; i < kPatchArea; ++i) {
    common += std::min(mask_[i], now[i]);
    all += mask_[i];
  }
  return all > 0 ? static_cast<double>(common) / all : 0.0;
}

std::optional<RefinedPosition> TargetModel::measure(const Scene& scene,
                                                    const RefinedPosition& placed,
                                                    const Eigen::Vector2d& likely_size_px) const {
  const auto coarse = refiner_.refine(scene.view, placed.centre, placed.size_px, likely_size_px);
  if (!coarse || !fine_refiner_) return coarse;
  // The reduced image loses edges, but only its gradients are wide enough to start from a
  // particle. The full image then starts from its result.
  const auto fine =
      fine_refiner_->refine(scene.whole, coarse->centre, coarse->size_px, coarse->size_px);
  const auto variance = [](const RefinedPosition& position) {
    return position.covariance_px2.topLeftCorner<2, 2>().trace();
  };
  const bool better = fine && variance(*fine) < variance(*coarse);
  return better ? fine : coarse;
}

void TargetModel::learn(const Scene& scene, const Eigen::Vector2d& pixel,
                        const Eigen::Vector2d& size_px, double share) {
  objective_.learn(sample_patch(scene.smooth, pixel, size_px), share);
  const double now = scene.contrast(pixel, size_px);
  set_contrast(now * contrast_ > 0.0 ? contrast_ + share * (now - contrast_) : now);
}

void TargetModel::learn_size(const Eigen::Vector2d& size_px, double share) {
  usual_size_px_ += share * (size_px - usual_size_px_);
}

Eigen::Vector2d TargetModel::follow_size(const cv::Mat& gray, const Particle& target,
                                         const std::optional<Eigen::Vector2d>& measured,
                                         double interval_s) {
  const auto seen = ScaleFilter::look_at(gray, target.pixel, target.size_px);
  if (!seen) return target.size_px;
  const double growth = measured ? 0.0 : scale_.growth(*seen);
  scale_.learn(*seen, growth, interval_s);
  if (measured) return target.size_px;
  usual_size_px_ *= std::exp(growth);
  return usual_size_px_;
}

void TargetModel::restart_size(const Eigen::Vector2d& size_px) {
  scale_ = {};
  usual_size_px_ *= std::sqrt(size_px.prod() / usual_size_px_.prod());
}

double TargetModel::log_likelihood(const Similarity& likeness, double background,
                                   double standing_out, const Eigen::Vector2d& size_px) const {
  const double room = std::max(0.02, 1.0 - background);
  const double alike =
      config_.sharpness * (likeness.similarity - 1.0) / room +
      config_.correlation_sharpness * (likeness.correlation - 1.0) +
      config_.contrast_sharpness * contrast_weight_ * (std::min(standing_out, 1.0) - 1.0);
  const double wider = std::log(size_px.x() / usual_size_px_.x());
  const double higher = std::log(size_px.y() / usual_size_px_.y());
  const double sd = config_.size_prior_sd_fraction;
  return alike - 0.5 * (wider * wider + higher * higher) / (sd * sd);
}

FrameEvidence TargetModel::evidence(const Scene& scene, const Particle& candidate) const {
  const auto& [pixel, velocity_px_s, size_px] = candidate;
  const Similarity found = likeness(scene, pixel, size_px);
  FrameEvidence evidence{found.similarity, scene.background_similarity, found.correlation,
                         found.contrast};
  evidence.standing_out = standing_out(scene, pixel, size_px);
  evidence.foreground = foreground(scene, pixel, size_px);
  evidence.by_subtraction = scene.mask_by_subtraction;
  return evidence;
}

void TargetModel::learn_mask(const Scene& scene, const Eigen::Vector2d& pixel,
                             const Eigen::Vector2d& size_px) {
  if (mask_learnt_ || !scene.mask_by_subtraction) return;
  mask_learnt_ = true;
  const MaskPatch mask = sample_mask(scene.mask, pixel, size_px);
  mask_ = mask;
  objective_.set_mask(mask);
  refiner_.set_mask(mask);
  if (fine_refiner_) fine_refiner_->set_mask(mask);
}

}  // namespace ols::tracker
