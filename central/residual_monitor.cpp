#include "central/residual_monitor.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ols {

// Mean excess of all stations: what to expect of one that has not shown much yet.
Eigen::Array2d ResidualMonitor::common_excess() const {
  Eigen::Array2d excess_rad2 = Eigen::Array2d::Zero();
  Eigen::Array2d weight = Eigen::Array2d::Constant(config_.prior_weight);
  for (const auto& [name, station] : stations_) {
    excess_rad2 += station.excess_rad2;
    weight += station.weight;
  }
  return (excess_rad2 / weight).max(0.0);
}

void ResidualMonitor::inflate(Ray& ray) const {
  const auto found = stations_.find(ray.station);
  const Station station = found == stations_.end() ? Station() : found->second;
  const Eigen::Array2d shown = (station.excess_rad2 + config_.common_weight * common_excess()) /
                               (station.weight + config_.common_weight);
  Eigen::Matrix2d& stays = ray.sight.covariance_systematic;
  stays.diagonal().array() +=
      (shown - config_.systematic_margin * stays.diagonal().array()).max(0.0);
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
    // Epochs close to each other share their bearings, and errors that stay for longer.
    const double news = std::min(1.0, elapsed_s / config_.independence_s);
    const Eigen::Array2d white = rays[i].sight.covariance_white.diagonal().array();
    // A ray far from its bearings tells of its motion, not of its station.
    const double weight =
        news * std::pow(std::min(1.0, rays[i].bearing_variance_rad2 / white.mean()), 2);
    const Eigen::Array2d redundancy = use.redundancy.array();
    const Eigen::Array2d most = config_.clip * redundancy * use.variance_rad2.array();
    const Eigen::Array2d squared_rad2 = use.residual_rad.array().square().min(most);
    station.epoch_us = epoch_us;
    station.weight = station.weight * decay + weight * redundancy;
    station.excess_rad2 =
        station.excess_rad2 * decay + weight * (squared_rad2 - redundancy * white);
    station.squared = station.squared * decay + weight * use.squared;
    station.expected = station.expected * decay + weight * use.expected;
  }
}

double ResidualMonitor::rms(const std::string& station) const {
  const auto found = stations_.find(station);
  if (found == stations_.end() || found->second.expected <= 0.0) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return std::sqrt(found->second.squared / found->second.expected);
}

}  // namespace ols
