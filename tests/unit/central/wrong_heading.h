// The bearings of several stations, one of which has a wrong heading.
#pragma once

#include <functional>
#include <random>
#include <string>
#include <vector>

#include "tests/unit/central/flight.h"

namespace ols::fusion::test {

// The error [rad] of a station's azimuth, as a function of the station's name and the time.
using HeadingError = std::function<double(char station, double t_s)>;

inline HeadingError off_by(char station, double degrees_off) {
  return [=](char name, double) { return name == station ? radians(degrees_off) : 0.0; };
}

inline constexpr double kSlowly = 0.5;  // factor of the speed of path() in flight.h

// The bearings of a target on the path of flight.h, at kSlowly times its speed, in order of time.
// `stations`: the letters of the square's corners, in the order of the exposures; each station has
// 15 per second.
inline std::vector<BearingMeasurement> watch(const std::string& stations, double seconds,
                                             double noise_rad, const HeadingError& heading,
                                             double stated_rad = 0.0) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::vector<BearingMeasurement> measurements;
  for (int i = 0; i < static_cast<int>(60.0 * seconds); ++i) {
    const double t_s = i / 60.0;
    const auto turn = static_cast<std::size_t>(i % 4);
    if (turn >= stations.size()) continue;
    const char name = stations[turn];
    Ray ray = ray_to(std::string(1, name), square()[static_cast<std::size_t>(name - 'a')],
                     path(kSlowly * t_s), noise_rad);
    ray = turned(ray, noise_rad * normal(random), noise_rad * normal(random));
    AzimuthElevation& direction = ray.sight.direction;
    direction.azimuth_rad = wrap_two_pi(direction.azimuth_rad + heading(name, t_s));
    ray.sight.covariance_systematic = Eigen::Matrix2d::Identity() * (stated_rad * stated_rad);
    measurements.push_back(measurement_of(ray, kStart + std::llround(t_s * 1e6)));
    measurements.back().clock_sd_s = 1e-3;
  }
  return measurements;
}

inline double slow_error_m(const FusedTarget& target) {
  const double t_s = static_cast<double>(target.utime_us - kStart) * 1e-6;
  return (target.estimate.position_ecef - site().to_ecef(path(kSlowly * t_s))).norm();
}

}  // namespace ols::fusion::test
