#include "land/scenery/scene_panorama.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/angles.h"
#include "land/refraction.h"

namespace ols::scenery {
namespace {

// The errors of one pose, each of the size of its sigma.
std::vector<PoseError> errors_of(const PoseSd& sd) {
  std::vector<PoseError> errors;
  errors.push_back({.heading_rad = sd.heading_rad});
  for (int axis = 0; axis < 2; ++axis) {
    errors.push_back({.tilt_rad = sd.tilt_rad * Eigen::Vector2d::Unit(axis)});
  }
  for (int axis = 0; axis < 3; ++axis) {
    errors.push_back({.position_enu_m = sd.position_m * Eigen::Vector3d::Unit(axis)});
  }
  return errors;
}

}  // namespace

ScenePanorama with_error(const ScenePanorama& panorama, const PoseError& error) {
  ScenePanorama wrong = panorama;
  // A heading is clockwise, seen from above.
  const Eigen::AngleAxisd heading(-error.heading_rad, Eigen::Vector3d::UnitZ());
  const Eigen::AngleAxisd east(error.tilt_rad.x(), Eigen::Vector3d::UnitX());
  const Eigen::AngleAxisd north(error.tilt_rad.y(), Eigen::Vector3d::UnitY());
  wrong.R_ecef_enu = panorama.R_ecef_enu * (heading * east * north).toRotationMatrix();
  wrong.centre_ecef += panorama.R_ecef_enu * error.position_enu_m;
  return wrong;
}

AzimuthElevation direction_of(const ScenePanorama& panorama, const Eigen::Vector2d& px) {
  return {wrap_two_pi(panorama.first_azimuth_rad + px.x() * panorama.rad_per_px),
          panorama.top_elevation_rad - px.y() * panorama.rad_per_px};
}

Eigen::Vector3d point_ecef(const ScenePanorama& panorama, const Eigen::Vector2d& px,
                           double range_m) {
  const AzimuthElevation direction = land::straight(direction_of(panorama, px), range_m);
  return panorama.centre_ecef +
         range_m * (panorama.R_ecef_enu * enu_from_azimuth_elevation(direction));
}

ScenePixel pixel_of(const ScenePanorama& panorama, const Eigen::Vector3d& p_ecef) {
  const Eigen::Vector3d enu_m = panorama.R_ecef_enu.transpose() * (p_ecef - panorama.centre_ecef);
  const double range_m = enu_m.norm();
  const AzimuthElevation direction = land::apparent(azimuth_elevation_from_enu(enu_m), range_m);
  const double half_rad = 0.5 * panorama.gray.cols * panorama.rad_per_px;
  const double middle_rad = panorama.first_azimuth_rad + half_rad;
  const double right_rad = half_rad + wrap_pi(direction.azimuth_rad - middle_rad);
  return {{right_rad / panorama.rad_per_px,
           (panorama.top_elevation_rad - direction.elevation_rad) / panorama.rad_per_px},
          range_m};
}

std::optional<double> range_m(const ScenePanorama& panorama, const ScenePanorama& other,
                              const Eigen::Vector2d& px, double other_x_px, double guess_m) {
  constexpr int kSteps = 8;
  constexpr double kSmall = 1e-4, kSame = 1e-9;
  const auto x_px = [&](double nearness) {
    return pixel_of(other, point_ecef(panorama, px, 1.0 / nearness)).px.x();
  };
  // A column is nearly linear in the inverse of the range.
  double nearness = 1.0 / guess_m;
  for (int i = 0; i < kSteps; ++i) {
    const double x = x_px(nearness);
    const double slope = (x_px(nearness * (1.0 + kSmall)) - x) / (kSmall * nearness);
    const double change = (other_x_px - x) / slope;
    if (!std::isfinite(change)) return std::nullopt;
    nearness += std::clamp(change, -0.5 * nearness, nearness);
    if (std::abs(change) < kSame * nearness) return 1.0 / nearness;
  }
  return std::nullopt;
}

double range_sd_m(const ScenePanorama& panorama, const ScenePanorama& other,
                  const Eigen::Vector2d& px, double other_x_px, double range_m) {
  double variance_m2 = 0.0;
  const auto add = [&](const ScenePanorama& one, const ScenePanorama& two) {
    const auto changed_m = scenery::range_m(one, two, px, other_x_px, range_m);
    variance_m2 += std::pow(changed_m.value_or(2.0 * range_m) - range_m, 2);
  };
  for (const PoseError& error : errors_of(panorama.sd)) add(with_error(panorama, error), other);
  for (const PoseError& error : errors_of(other.sd)) add(panorama, with_error(other, error));
  return std::sqrt(variance_m2);
}

}  // namespace ols::scenery
