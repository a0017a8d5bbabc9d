#include "export/uncertainty.h"

#include <algorithm>
#include <cmath>

#include "geometry/angles.h"

namespace ols::exports {

Ellipse ellipse_of(const Covariance& enu) {
  const double ee = enu[0], en = enu[1], nn = enu[3];
  const double mean = (ee + nn) / 2.0;
  const double radius = std::hypot((ee - nn) / 2.0, en);
  if (!std::isfinite(mean + radius) || mean - radius < -1e-9 * std::abs(mean)) return {};
  // The angle from north towards east of the axis with the larger variance.
  const double azimuth = 0.5 * std::atan2(2.0 * en, nn - ee);
  return {std::sqrt(mean + radius), std::sqrt(std::max(0.0, mean - radius)),
          degrees(azimuth < 0.0 ? azimuth + kPi : azimuth)};
}

double sd(double variance) {
  return std::isfinite(variance) && variance >= 0.0 ? std::sqrt(variance) : kUnknown;
}

double rounded_up(double value, int decimals) {
  constexpr double kRounding = 1e-9;  // a product that should be whole may lie this much above
  const double scale = std::pow(10.0, decimals);
  return std::ceil(value * scale - kRounding) / scale;
}

Motion motion_of(const Target& target) {
  const auto& [east, north, up] = target.velocity_enu_m_s;
  if (!std::isfinite(east + north)) return {};
  return {std::hypot(east, north), degrees(wrap_two_pi(std::atan2(east, north))), up};
}

}  // namespace ols::exports
