#include "edge/tracker/point_measurement.h"

#include <algorithm>
#include <cmath>

namespace ols::tracker {
namespace {

constexpr double kSameShape = 0.9;       // correlation; below it the size is not measured
constexpr double kSharedByChance = 1.2;  // white noise reaches this by fluctuation
constexpr double kSharedNoiseTime_s = 1.0;

}  // namespace

MeasuredPoint PointMeasurement::measure(const TargetModel& target, const Scene& scene,
                                        const RefinedPosition& placed,
                                        const Eigen::Vector2d& filter_size_px,
                                        const Eigen::Vector2d& place, double interval_s) {
  const auto measured = target.measure(scene, placed, size_px_.value_or(filter_size_px));
  size_px_.reset();
  const bool usable = measured && measured->correlation >= kSamePattern;
  if (usable && measured->correlation > kSameShape) size_px_ = measured->size_px;
  const RefinedPosition& position = usable ? *measured : placed;
  learn_shared_noise(position.shared_noise, interval_s);
  return {position.point(place),
          std::max(1.0, shared_noise_ / kSharedByChance) * position.point_covariance_px2(place)};
}

void PointMeasurement::restart() {
  size_px_.reset();
  shared_noise_count_ = 0;
}

// The mean of the first ones, later of the last second: a single frame fluctuates much.
void PointMeasurement::learn_shared_noise(double shared_noise, double interval_s) {
  const double share =
      std::max(1.0 / ++shared_noise_count_, 1.0 - std::exp(-interval_s / kSharedNoiseTime_s));
  shared_noise_ += share * (shared_noise - shared_noise_);
}

}  // namespace ols::tracker
