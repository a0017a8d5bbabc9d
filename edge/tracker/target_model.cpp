#include "edge/tracker/target_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ols {
namespace {

cv::Rect widened(const cv::Rect2d& box, double sides) {
  const double x = sides * box.width;
  const double y = sides * box.height;
  return {static_cast<int>(std::floor(box.x - x)), static_cast<int>(std::floor(box.y - y)),
          static_cast<int>(std::ceil(box.width + 2.0 * x)) + 1,
          static_cast<int>(std::ceil(box.height + 2.0 * y)) + 1};
}

// The part of the frame that the particles and the background's samples look at.
cv::Rect looked_at(const std::vector<Particle>& particles, const cv::Rect2d& expected) {
  cv::Rect2d area = widened(expected, 3.0);
  for (const Particle& particle : particles) area |= box_of(particle.pixel, particle.size_px);
  return widened(area, 0.0);
}

}  // namespace

TargetModel::TargetModel(const TrackerConfig& config, const cv::Mat& gray, const cv::Rect2d& box)
    : TargetModel(config, make_view(gray, widened(box, 3.0), reduction_for(size_of(box))), box) {
  // M_t until an earlier image shows the background alone.
  const Scene scene = make_scene(gray, {}, box, ReferenceFrames(config.reference_interval_s));
  objective_.set_mask(sample_mask(scene.mask, centre_of(box), size_of(box)));
}

TargetModel::TargetModel(const TrackerConfig& config, const View& view, const cv::Rect2d& box)
    : config_(config),
      first_size_px_(size_of(box)),
      template_(make_template(view, centre_of(box), size_of(box))),
      objective_(template_),
      refiner_(view, centre_of(box), size_of(box)) {}

Scene TargetModel::make_scene(const cv::Mat& gray, const std::vector<Particle>& particles,
                              const cv::Rect2d& expected, const ReferenceFrames& references) const {
  const cv::Rect area = looked_at(particles, expected);
  Scene scene;
  scene.frame = gray.size();
  scene.view = make_view(gray, area, reduction_for(first_size_px_));
  if (const auto* reference = references.without_overlap(expected)) {
    scene.mask = foreground_mask(gray, *reference, area, template_);
    scene.mask_by_subtraction = true;
  } else {
    const float level = level_around(scene.view, centre_of(expected), size_of(expected));
    scene.mask = foreground_mask(gray, static_cast<double>(level), area, template_);
  }
  return scene;
}

Likeness TargetModel::likeness(const Scene& scene, const Eigen::Vector2d& pixel,
                               const Eigen::Vector2d& size_px) const {
  const bool seen = pixel.x() > -0.5 && pixel.y() > -0.5 && pixel.x() < scene.frame.width - 0.5 &&
                    pixel.y() < scene.frame.height - 0.5;
  if (!seen) return {};
  const MaskPatch mask = sample_mask(scene.mask, pixel, size_px);
  return objective_(sample_patch(scene.view, pixel, size_px), mask);
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

double TargetModel::log_likelihood(const Likeness& likeness, double background,
                                   const Eigen::Vector2d& size_px) const {
  const double room = std::max(0.02, 1.0 - background);
  const double alike = config_.sharpness * (likeness.similarity - 1.0) / room +
                       config_.correlation_sharpness * (likeness.correlation - 1.0);
  const double wider = std::log(size_px.x() / first_size_px_.x());
  const double higher = std::log(size_px.y() / first_size_px_.y());
  const double sd = config_.size_prior_sd_fraction;
  return alike - 0.5 * (wider * wider + higher * higher) / (sd * sd);
}

void TargetModel::learn_mask(const Scene& scene, const Eigen::Vector2d& pixel,
                             const Eigen::Vector2d& size_px) {
  if (mask_learnt_ || !scene.mask_by_subtraction) return;
  mask_learnt_ = true;
  const MaskPatch mask = sample_mask(scene.mask, pixel, size_px);
  objective_.set_mask(mask);
  refiner_.set_mask(mask);
}

}  // namespace ols
