#include "edge/camera/exposure_log.h"

#include <cmath>

namespace ols::camera {
namespace {

constexpr std::size_t kKept = 8;  // changes; a frame is at most a few periods old

}  // namespace

void ExposureLog::change(double asked_s, double granted_s, double exposure_s) {
  changes_.push_back({asked_s, granted_s, exposure_s});
  if (changes_.size() <= kKept) return;
  first_s_ = changes_.front().exposure_s;
  changes_.pop_front();
}

ExposureUsed ExposureLog::at(double start_s) const {
  ExposureUsed used{.exposure_s = first_s_};
  for (const Change& c : changes_) {
    if (start_s < c.asked_s) break;
    if (start_s > c.granted_s + frame_period_s_) {
      used = {.exposure_s = c.exposure_s};
    } else {
      // Either one, with equal probability.
      const double half = 0.5 * (c.exposure_s - used.exposure_s);
      used = {.exposure_s = used.exposure_s + half, .sd_s = std::hypot(used.sd_s, half)};
    }
  }
  return used;
}

}  // namespace ols::camera
