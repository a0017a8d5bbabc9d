#include "edge/mount/approach_history.h"

#include <algorithm>
#include <cmath>

namespace ols::mount {
namespace {

constexpr double kSpan_s = 10.0;  // no bearing waits as long for its angles
constexpr double kMoved_counts = 1.5;

}  // namespace

bool ApproachHistory::Axis::add(double angle_rad, double step_rad) {
  if (!known) {
    known = true;
    extreme_rad = angle_rad;
    return false;
  }
  const double way_rad = angle_rad - extreme_rad;
  if (sign != 0 && way_rad * sign >= 0.0) {
    extreme_rad = angle_rad;
    return false;
  }
  if (std::abs(way_rad) < kMoved_counts * step_rad) return false;
  sign = way_rad > 0.0 ? 1 : -1;
  extreme_rad = angle_rad;
  return true;
}

void ApproachHistory::add(double time_s, const PanTilt& reported) {
  const bool pan_changed = pan_.add(reported.pan_rad, step_.pan_rad);
  const bool tilt_changed = tilt_.add(reported.tilt_rad, step_.tilt_rad);
  if (pan_changed || tilt_changed) changes_.push_back({time_s, {pan_.sign, tilt_.sign}});
  while (changes_.size() > 1 && changes_[1].time_s < time_s - kSpan_s) changes_.pop_front();
}

void ApproachHistory::clear() {
  pan_ = tilt_ = {};
  changes_.clear();
}

Approach ApproachHistory::at(double time_s) const {
  // A motion that a sample shows had begun before it: between two samples the later one decides.
  constexpr double kSample_s = 0.025;
  const auto after = std::find_if(changes_.begin(), changes_.end(), [time_s](const Change& change) {
    return change.time_s > time_s + kSample_s;
  });
  return after == changes_.begin() ? Approach{} : std::prev(after)->approach;
}

}  // namespace ols::mount
