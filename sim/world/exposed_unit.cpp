#include "sim/world/exposed_unit.h"

#include <algorithm>

namespace ols::sim {

void ExposedUnit::expose(const std::function<PanTilt(double)>& counted, double mid_s,
                         ExposureTruth& exposure) {
  // The slack is followed in steps; what a unit does within one is shorter than its slack.
  constexpr double kStep_s = 0.004, kKept_s = 1.8;
  const double half_s = 0.5 * exposure.exposure_s;
  if (exact_) {
    exposure.start = counted(mid_s - half_s);
    exposure.mid = counted(mid_s);
    exposure.end = counted(mid_s + half_s);
    return;
  }
  const double seen_s = mid_s + offset_s_;
  double at_s = std::max(followed_s_.value_or(seen_s - kStep_s), seen_s - kKept_s);
  for (; at_s < seen_s; at_s += kStep_s) mechanics_.follow(counted(at_s));
  const PanTilt mid = counted(seen_s);
  mechanics_.follow(mid);
  followed_s_ = seen_s;
  exposure.mid = mechanics_.shafts(mid);
  // The jitter of a count does not move within an exposure.
  const auto moved = [&](double by_s) {
    const PanTilt there = counted(seen_s + by_s);
    return PanTilt{exposure.mid.pan_rad + there.pan_rad - mid.pan_rad,
                   exposure.mid.tilt_rad + there.tilt_rad - mid.tilt_rad};
  };
  exposure.start = moved(-half_s);
  exposure.end = moved(half_s);
}

}  // namespace ols::sim
