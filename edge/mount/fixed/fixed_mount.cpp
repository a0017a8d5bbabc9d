#include "edge/mount/fixed/fixed_mount.h"

#include <algorithm>
#include <cstdio>

#include "base/process/clocks.h"
#include "geometry/angles.h"

namespace ols::mount {
namespace {

constexpr double kSample_s = 0.05;
constexpr double kLongest_s = 1.0;  // of samples at once, after a pause of the caller

}  // namespace

Limits fixed_limits(const PanTilt& angles) {
  return {angles.pan_rad,
          angles.pan_rad,
          angles.tilt_rad,
          angles.tilt_rad,
          {},
          {kVirtualCount_rad, kVirtualCount_rad}};
}

std::string fixed_words(const PanTilt& angles) {
  char text[80];
  std::snprintf(text, sizeof text, "fixed at pan %.2f, tilt %.2f deg", degrees(angles.pan_rad),
                degrees(angles.tilt_rad));
  return text;
}

std::vector<AngleSample> fixed_samples(const PanTilt& angles, double last_s, double now_s) {
  std::vector<AngleSample> samples;
  const double first_s = std::max(last_s + kSample_s, now_s - kLongest_s);
  for (double time_s = first_s; time_s <= now_s; time_s += kSample_s) {
    samples.push_back({.time_s = time_s, .angles = angles});
  }
  return samples;
}

std::vector<AngleSample> FixedMount::take_samples() {
  auto samples = fixed_samples(config_.angles, last_s_, clock_monotonic_s());
  if (!samples.empty()) last_s_ = samples.back().time_s;
  return samples;
}

device::DeviceReport FixedMount::report() const {
  device::DeviceReport report;
  report.name = "ptu";
  report.state = device::DeviceState::kOk;
  report.text = fixed_words(config_.angles);
  report.last_good_s = clock_monotonic_s();
  return report;
}

}  // namespace ols::mount
