// The designated point in a frame that shows the target, with its covariance.
#pragma once

#include <optional>

#include "edge/tracker/target_model.h"

namespace ols::tracker {

inline constexpr double kSamePattern = 0.5;  // correlation; below it the position is not measured

struct MeasuredPoint {
  Eigen::Vector2d pixel;
  Eigen::Matrix2d covariance_px2;  // without the configured minimum
};

class PointMeasurement {
 public:
  // `placed`: the fit of the box with the filter's size. `place`: the point's position, in sizes
  // from the centre. Tracking uses the size on which the particles agree, because smeared images do
  // not mislead it. The output uses the size that this image shows.
  MeasuredPoint measure(const TargetModel& target, const Scene& scene,
                        const RefinedPosition& placed, const Eigen::Vector2d& filter_size_px,
                        const Eigen::Vector2d& place, double interval_s);
  // The newest frame does not show the target.
  void miss() { size_px_.reset(); }
  // Another target, or a new start.
  void restart();
  // Size from the first image, measured in the newest frame. The box also follows the learnt
  // appearance.
  const std::optional<Eigen::Vector2d>& size_px() const { return size_px_; }

 private:
  void learn_shared_noise(double shared_noise, double interval_s);

  std::optional<Eigen::Vector2d> size_px_;
  int shared_noise_count_ = 0;
  double shared_noise_ = 1.0;  // recent value of RefinedPosition's
};

}  // namespace ols::tracker
