#include "sim/ptu/external_mount.h"

namespace ols::sim {
namespace {

mount::AngleHistory::Config history_config() {
  mount::AngleHistory::Config config;
  config.span_s = 3.0;  // more than the two seconds that PtuDevice promises
  config.max_extrapolation_s = 0.0;
  return config;
}

}  // namespace

ExternalMount::ExternalMount() : history_(history_config()) {}

void ExternalMount::state(double monotonic_s, const PanTilt& angles) {
  const std::lock_guard lock(mutex_);
  mount::AngleSample sample;
  sample.time_s = monotonic_s;
  sample.angles = angles;
  history_.add(sample);
}

PanTilt ExternalMount::angles_at(double monotonic_s) {
  const std::lock_guard lock(mutex_);
  if (const auto known = history_.at(monotonic_s)) return known->angles;
  const auto newest = history_.newest();
  return newest ? newest->angles : PanTilt{};
}

}  // namespace ols::sim
