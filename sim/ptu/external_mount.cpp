#include "sim/ptu/external_mount.h"

#include <algorithm>
#include <cmath>

namespace ols::sim {
namespace {

constexpr double kKept_s = 3.0;  // more than the two seconds that PtuDevice promises

}  // namespace

void ExternalMount::state(double monotonic_s, const PanTilt& angles) {
  const std::lock_guard lock(mutex_);
  if (!stated_.empty() && !(monotonic_s > stated_.back().at_s)) return;
  stated_.push_back({monotonic_s, angles});
  while (stated_.size() > 2 && stated_[1].at_s < monotonic_s - kKept_s) stated_.pop_front();
}

PanTilt ExternalMount::angles_at(double monotonic_s) {
  const std::lock_guard lock(mutex_);
  if (stated_.empty()) return {};
  const auto after = std::ranges::upper_bound(stated_, monotonic_s, {}, &Stated::at_s);
  if (after == stated_.begin()) return after->angles;
  const Stated& before = *std::prev(after);
  if (after == stated_.end()) return before.angles;
  const double share = (monotonic_s - before.at_s) / (after->at_s - before.at_s);
  return {std::lerp(before.angles.pan_rad, after->angles.pan_rad, share),
          std::lerp(before.angles.tilt_rad, after->angles.tilt_rad, share)};
}

}  // namespace ols::sim
