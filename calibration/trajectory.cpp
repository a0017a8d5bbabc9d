#include "calibration/trajectory.h"

#include <algorithm>

namespace ols::calibration {

Motion motion_at(const Trajectory& trajectory, double utime_us) {
  constexpr double kMicrosecond_s = 1e-6;
  const auto& points = trajectory.points;
  const auto after = std::ranges::upper_bound(
      points, utime_us, {},
      [](const Trajectory::Point& point) { return static_cast<double>(point.utime_us); });
  const auto to = std::clamp(after, points.begin() + 1, points.end() - 1);
  const auto from = to - 1;
  const double span_s = kMicrosecond_s * static_cast<double>(to->utime_us - from->utime_us);
  const Eigen::Vector3d velocity = (to->ecef - from->ecef) / span_s;
  const double since_s = kMicrosecond_s * (utime_us - static_cast<double>(from->utime_us));
  const bool is_known = since_s == 0.0 || since_s == span_s;
  return {from->ecef + since_s * velocity, velocity, is_known ? 0.0 : span_s};
}

}  // namespace ols::calibration
