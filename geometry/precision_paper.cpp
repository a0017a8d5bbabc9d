#include "geometry/precision_paper.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "geometry/angles.h"
#include "geometry/direction.h"

namespace ols {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

// Where the rays from (0, 0) and (base, 0) at these angles from the x axis meet, in front of both.
std::optional<Vector2d> meeting_point(double base_m, double first_rad, double second_rad) {
  const double sine = std::sin(second_rad - first_rad);
  const double range_first = base_m * std::sin(second_rad) / sine;
  const double range_second = base_m * std::sin(first_rad) / sine;
  if (!(range_first >= 0.0 && range_second >= 0.0)) return std::nullopt;
  return Vector2d(range_first * std::cos(first_rad), range_first * std::sin(first_rad));
}

}  // namespace

double canonical_stereo_error_m(const PixelError& error, double base_m, double depth_m) {
  const double tangent = error.tangent();
  const double rest = base_m - tangent * depth_m;
  return rest > 0.0 ? tangent * depth_m * depth_m / rest : kUnbounded;
}

double rotating_pair_error_m(const PixelError& error, double base_m, double distance_m) {
  const double angle = std::atan2(distance_m, base_m) + std::atan(error.tangent());
  return angle < 0.5 * kPi ? base_m * std::tan(angle) - distance_m : kUnbounded;
}

double pair_error_m(const Vector3d& first, const Vector3d& second, const Vector3d& target,
                    double angle_rad) {
  const Vector3d base = second - first;
  const double base_m = base.norm();
  const double first_rad = angle_between(base, target - first);
  const double second_rad = kPi - angle_between(-base, target - second);
  // Rays that can be parallel or part leave the wedges' intersection open at its far end.
  if (second_rad - first_rad <= 2.0 * angle_rad) return kUnbounded;
  const double range_m = (target - first).norm();
  const Vector2d truth(range_m * std::cos(first_rad), range_m * std::sin(first_rad));
  double greatest_m = 0.0;
  for (const double sign_first : {-1.0, 1.0}) {
    for (const double sign_second : {-1.0, 1.0}) {
      const auto corner = meeting_point(base_m, first_rad + sign_first * angle_rad,
                                        second_rad + sign_second * angle_rad);
      if (corner) greatest_m = std::max(greatest_m, (*corner - truth).norm());
    }
  }
  // Each wedge's apex is a corner too where the other wedge covers it.
  if (kPi - second_rad <= angle_rad) greatest_m = std::max(greatest_m, truth.norm());
  if (first_rad <= angle_rad) greatest_m = std::max(greatest_m, (target - second).norm());
  return greatest_m;
}

double normal_component(const Baseline& baseline, const Vector3d& target) {
  const Vector3d along = (baseline.second - baseline.first).normalized();
  const Vector3d to_target = target - 0.5 * (baseline.first + baseline.second);
  const double distance_m = to_target.norm();
  return distance_m > 0.0 ? along.cross(to_target).norm() / distance_m : 0.0;
}

std::size_t best_baseline(std::span<const Baseline> baselines, const Vector3d& target) {
  if (baselines.empty()) throw std::invalid_argument("best_baseline: no baseline is given");
  const auto best = std::ranges::max_element(
      baselines, {}, [&](const Baseline& baseline) { return normal_component(baseline, target); });
  return static_cast<std::size_t>(best - baselines.begin());
}

Vector3d table_target(double base_m, double distance_m, double alpha_rad, int side) {
  const Vector3d direction(side < 0 ? -std::sin(alpha_rad) : std::sin(alpha_rad),
                           std::cos(alpha_rad), 0.0);
  if (side == 0) return distance_m * direction;
  // |s direction - first|^2 = distance^2 with first = (-base / 2, 0, 0).
  const double half_m = 0.5 * base_m;
  const double projection = half_m * direction.x();
  const double root = projection * projection + distance_m * distance_m - half_m * half_m;
  if (root < 0.0) throw std::invalid_argument("table_target: no such place");
  return (std::sqrt(root) - projection) * direction;
}

}  // namespace ols
