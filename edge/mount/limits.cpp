#include "edge/mount/limits.h"

#include <cmath>
#include <optional>

#include "geometry/angles.h"

namespace ols::mount {
namespace {

// The length of the way to `to`; nullopt if there is none.
std::optional<double> way_length(const Limits& limits, const PanTilt& now, const PanTilt& to) {
  if (to.pan_rad < limits.pan_min_rad || to.pan_rad > limits.pan_max_rad) return std::nullopt;
  if (limits.keep_out.empty()) return std::abs(to.pan_rad - now.pan_rad);
  const auto way = way_round(travel(limits), limits.keep_out, now, to);
  if (!way) return std::nullopt;
  double sum = 0.0;
  PanTilt at = now;
  for (const PanTilt& next : *way) {
    sum += std::abs(next.pan_rad - at.pan_rad) + std::abs(next.tilt_rad - at.tilt_rad);
    at = next;
  }
  return sum;
}

}  // namespace

AngleBox travel(const Limits& limits) {
  return {limits.pan_min_rad, limits.pan_max_rad, limits.tilt_min_rad, limits.tilt_max_rad};
}

Reach reach(const Limits& limits, const PanTilt& now, PanTilt& angles) {
  if (!std::isfinite(angles.pan_rad) || !std::isfinite(angles.tilt_rad)) return Reach::kUnreachable;
  if (angles.tilt_rad < limits.tilt_min_rad || angles.tilt_rad > limits.tilt_max_rad) {
    return Reach::kUnreachable;
  }
  const double nearest_rad = now.pan_rad + wrap_pi(angles.pan_rad - now.pan_rad);
  std::optional<double> best_rad, shortest;
  for (const double turn : {0.0, -2.0 * kPi, 2.0 * kPi}) {
    const PanTilt there{nearest_rad + turn, angles.tilt_rad};
    const auto way = way_length(limits, now, there);
    if (!way || (shortest && *way >= *shortest)) continue;
    shortest = way;
    best_rad = there.pan_rad;
  }
  if (!best_rad) return Reach::kUnreachable;
  angles.pan_rad = *best_rad;
  const bool straight = *best_rad == nearest_rad && !blocked(limits.keep_out, spanned(now, angles));
  return straight ? Reach::kDirect : Reach::kLongWayRound;
}

}  // namespace ols::mount
