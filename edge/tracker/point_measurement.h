// Measures the designated point in a frame that shows the target, with its covariance.
#pragma once

#include <optional>

#include "edge/tracker/target_model.h"

namespace ols::tracker {

// Minimum correlation with the first image at which the position counts as measured.
inline constexpr double kSamePattern = 0.5;

struct MeasuredPoint {
  Eigen::Vector2d pixel;
  Eigen::Matrix2d covariance_px2;  // without TrackerConfig::pixel_sd_floor_px
};

class PointMeasurement {
 public:
  // `placed`: the fit of a box with the filter's size. `place`: the point's position relative to
  // the box's centre, in units of the box's width and height. Tracking uses `filter_size_px`, which
  // blurred images do not change. The output uses the size that this image shows.
  MeasuredPoint measure(const TargetModel& target, const Scene& scene,
                        const RefinedPosition& placed, const Eigen::Vector2d& filter_size_px,
                        const Eigen::Vector2d& place, double interval_s);
  // Call if the newest frame does not show the target.
  void miss() { size_px_.reset(); }
  // Call when another target is tracked, or when the search starts at a new place.
  void restart();
  // The size in the newest frame, measured by comparison with the first image; nullopt if it was
  // not measured. The box of TrackerOutput may have another size, because it also follows the
  // learnt appearance.
  const std::optional<Eigen::Vector2d>& size_px() const { return size_px_; }

 private:
  void learn_shared_noise(double shared_noise, double interval_s);

  std::optional<Eigen::Vector2d> size_px_;
  int shared_noise_count_ = 0;
  double shared_noise_ = 1.0;  // recent value of RefinedPosition::shared_noise
};

}  // namespace ols::tracker
