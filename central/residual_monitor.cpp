#include "central/residual_monitor.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ols {

void ResidualMonitor::inflate(Ray& ray) const {
  const auto found = stations_.find(ray.station);
  if (found == stations_.end()) return;
  const Station& station = found->second;
  const double white = ray.sight.covariance_white.trace() / 2.0;
  const double stated = ray.sight.covariance_systematic.trace() / 2.0;
  const double prior = config_.prior_weight;
  const double shown = (station.variance + prior * (white + stated)) / (station.weight + prior);
  const double excess = shown - white - config_.systematic_margin * stated;
  if (excess > 0.0) ray.sight.covariance_systematic.diagonal().array() += excess;
}

void ResidualMonitor::observe(const std::vector<Ray>& rays, const Estimate& estimate,
                              std::int64_t epoch_us) {
  if (estimate.solution != Solution::kOk) return;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const RayUse& use = estimate.rays[i];
    if (!(use.expected > 0.0)) continue;
    Station& station = stations_[rays[i].station];
    const double elapsed_s = std::max(0.0, static_cast<double>(epoch_us - station.epoch_us) * 1e-6);
    const double decay = std::exp(-elapsed_s / config_.memory_s);
    const double squared = std::min(use.squared, config_.clip * use.expected);
    station.epoch_us = epoch_us;
    station.weight = station.weight * decay + use.expected;
    station.squared = station.squared * decay + squared;
    station.variance = station.variance * decay + squared * use.variance_rad2;
  }
}

double ResidualMonitor::rms(const std::string& station) const {
  const auto found = stations_.find(station);
  if (found == stations_.end() || found->second.weight <= 0.0) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return std::sqrt(found->second.squared / found->second.weight);
}

}  // namespace ols
