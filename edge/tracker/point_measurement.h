// Measures the designated point in a frame that shows the target, with its covariance.
#pragma once

#include <optional>

#include "edge/tracker/target_model.h"

namespace ols::tracker {

// If the correlation is lower, the position is not measured.
inline constexpr double kSamePattern = 0.5;

struct MeasuredPoint {
  Eigen::Vector2d pixel;
  Eigen::Matrix2d covariance_px2;  // without the configured minimum
};

class PointMeasurement {
 public:
  // `placed`: the fit of a box with the filter's size. `place`: the point's position relative to
  // the box's centre, in sizes of the box. Tracking uses the size on which the particles agree,
  // because blurred images do not change that size. The output uses the size that this image shows.
  MeasuredPoint measure(const TargetModel& target, const Scene& scene,
                        const RefinedPosition& placed, const Eigen::Vector2d& filter_size_px,
                        const Eigen::Vector2d& place, double interval_s);
  // Call if the newest frame does not show the target.
  void miss() { size_px_.reset(); }
  // Call for another target, or a new start.
  void restart();
  // The size in the newest frame, measured relative to the first image; nullopt if it was not
  // measured. The output's box also follows the learnt appearance.
  const std::optional<Eigen::Vector2d>& size_px() const { return size_px_; }

 private:
  void learn_shared_noise(double shared_noise, double interval_s);

  std::optional<Eigen::Vector2d> size_px_;
  int shared_noise_count_ = 0;
  double shared_noise_ = 1.0;  // recent value of RefinedPosition::shared_noise
};

}  // namespace ols::tracker
