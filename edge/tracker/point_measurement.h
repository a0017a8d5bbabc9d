// The designated point in a frame that shows the target, with its covariance.
#pragma once

#include <optional>

#include "edge/tracker/target_model.h"

namespace ols::tracker {

inline constexpr double kSamePattern = 0.5;  // correlation; less is no measurement of its place

struct MeasuredPoint {
  Eigen::Vector2d pixel;
  Eigen::Matrix2d covariance_px2;  // without the floor of the configuration
};

class PointMeasurement {
 public:
  // `placed` is where the box of the filter's size fits; `place` is the point's, in sizes from the
  // centre. What is followed goes by a size that the particles agree on, which no smeared image
  // leads astray; what is told, by the one that this image shows.
  MeasuredPoint measure(const TargetModel& target, const Scene& scene,
                        const RefinedPosition& placed, const Eigen::Vector2d& filter_size_px,
                        const Eigen::Vector2d& place, double interval_s);
  // The newest frame does not show the target.
  void miss() { size_px_.reset(); }
  // It is another target, or begins anew.
  void restart();
  // Of the first image in the newest frame: the box is of what has been learnt since, too.
  const std::optional<Eigen::Vector2d>& size_px() const { return size_px_; }

 private:
  void learn_shared_noise(double shared_noise, double interval_s);

  std::optional<Eigen::Vector2d> size_px_;
  int shared_noise_count_ = 0;
  double shared_noise_ = 1.0;  // RefinedPosition's, of late
};

}  // namespace ols::tracker
