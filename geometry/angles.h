// Conversion and wrapping of plane angles.
#pragma once

#include <cmath>
#include <numbers>

namespace ols {

inline constexpr double kPi = std::numbers::pi;

constexpr double radians(double deg) { return deg * (kPi / 180.0); }
constexpr double degrees(double rad) { return rad * (180.0 / kPi); }

// Wraps an angle [rad] to -pi..pi.
inline double wrap_pi(double rad) { return std::remainder(rad, 2.0 * kPi); }

// Wraps an angle [rad] to 0..2 pi (2 pi itself becomes 0).
inline double wrap_two_pi(double rad) {
  const double wrapped = std::fmod(rad, 2.0 * kPi);
  const double positive = wrapped < 0.0 ? wrapped + 2.0 * kPi : wrapped;
  return positive < 2.0 * kPi ? positive : 0.0;
}

}  // namespace ols
