// The bearings of a target that flies past four stations.
#pragma once

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "central/fusion/fusion.h"
#include "tests/unit/central/scene.h"

namespace ols::fusion::test {

inline constexpr std::int64_t kStart = 1'700'000'000'000'000;

inline Eigen::Vector3d path(double t_s) {
  return {-100.0 + 20.0 * t_s, 150.0 - 5.0 * t_s, 120.0 + 2.0 * t_s};
}

// Bearings of four stations with 15 frames per second, evenly staggered, in order of time.
inline std::vector<BearingMeasurement> flight(double seconds, double sigma_rad = 1e-5,
                                              double noise = 0.0) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  std::vector<BearingMeasurement> measurements;
  for (int i = 0; i < static_cast<int>(60.0 * seconds); ++i) {
    const double t_s = i / 60.0;
    const auto station = static_cast<std::size_t>(i % 4);
    Ray ray = ray_to(std::string(1, static_cast<char>('a' + i % 4)), square()[station], path(t_s),
                     sigma_rad);
    ray = turned(ray, noise * normal(random), noise * normal(random));
    measurements.push_back(measurement_of(ray, kStart + std::llround(t_s * 1e6)));
  }
  return measurements;
}

// Updates the filter with a bearing, and the bias model with the evidence from it.
inline BearingUse feed(TrackFilter& filter, const BearingMeasurement& measurement,
                       BiasModel& errors) {
  const FilterUpdate update = filter.update(measurement, errors);
  errors.learn(update.evidence);
  return update.use;
}

inline void move_on(TrackFilter& filter, std::int64_t utime_us, BiasModel& errors) {
  errors.learn(filter.advance(utime_us, errors));
}

inline std::vector<FusedTarget> targets_of(Fusion& fusion,
                                           const std::vector<BearingMeasurement>& measurements) {
  std::vector<FusedTarget> targets;
  for (const BearingMeasurement& measurement : measurements) {
    const FusionOutput output = fusion.add(measurement);
    targets.insert(targets.end(), output.targets.begin(), output.targets.end());
  }
  return targets;
}

inline double error_m(const FusedTarget& target) {
  const double t_s = static_cast<double>(target.utime_us - kStart) * 1e-6;
  return (target.estimate.position_ecef - site().to_ecef(path(t_s))).norm();
}

}  // namespace ols::fusion::test
