#include "central/ground/above_ground.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "geometry/chi_square.h"
#include "geometry/wgs84.h"

namespace ols::fusion {

std::optional<LocalGround> local_ground(const land::Surface& surface, const Eigen::Vector3d& p_ecef,
                                        const Eigen::Matrix3d& covariance_enu_m2) {
  constexpr double kLeast_m = 5.0;
  const LocalFrame frame(geodetic_from_ecef(p_ecef));
  const auto ground_at = [&](const Eigen::Vector2d& offset) {
    const Geodetic at =
        geodetic_from_ecef(frame.to_ecef(Eigen::Vector3d(offset.x(), offset.y(), 0.0)));
    return surface.ground(at.latitude_rad, at.longitude_rad);
  };
  const auto below = ground_at(Eigen::Vector2d::Zero());
  if (!below) return std::nullopt;
  LocalGround ground{.height_m = below->height_m};
  double bent_m2 = 0.0;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(
      Eigen::Matrix2d(covariance_enu_m2.topLeftCorner<2, 2>()));
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d axis = axes.eigenvectors().col(i);
    const double step_m = std::max(kLeast_m, std::sqrt(std::max(0.0, axes.eigenvalues()(i))));
    const auto ahead = ground_at(step_m * axis), behind = ground_at(-step_m * axis);
    if (!ahead || !behind) return std::nullopt;
    ground.slope += (ahead->height_m - behind->height_m) / (2.0 * step_m) * axis;
    bent_m2 += std::pow((ahead->height_m + behind->height_m) / 2.0 - below->height_m, 2);
  }
  ground.sd_m = std::sqrt(below->sd_m * below->sd_m + bent_m2);
  return ground;
}

std::optional<HeightAboveGround> height_above_ground(const land::Surface& surface,
                                                     const Eigen::Vector3d& p_ecef,
                                                     const Eigen::Matrix3d& covariance_ecef) {
  const Geodetic at = geodetic_from_ecef(p_ecef);
  const Eigen::Matrix3d R = R_ecef_enu(at);
  const Eigen::Matrix3d P = R.transpose() * covariance_ecef * R;
  const auto ground = local_ground(surface, p_ecef, P);
  if (!ground) return std::nullopt;
  const Eigen::Vector3d up(-ground->slope.x(), -ground->slope.y(), 1.0);
  return HeightAboveGround{at.height_m - ground->height_m,
                           std::sqrt(up.dot(P * up) + ground->sd_m * ground->sd_m)};
}

double probability_above(const std::optional<HeightAboveGround>& height) {
  return height ? normal_level(-height->height_m / height->sd_m) : 1.0;
}

std::optional<Position> put_on_ground(const land::Surface& surface, const Position& position) {
  constexpr double kFar = 9.0;  // squared normalised distance
  const Geodetic at = geodetic_from_ecef(position.p_ecef);
  const Eigen::Matrix3d R = R_ecef_enu(at);
  const Eigen::Matrix3d P = R.transpose() * position.covariance_ecef * R;
  const auto ground = local_ground(surface, position.p_ecef, P);
  if (!ground) return std::nullopt;
  const Eigen::Vector3d up(-ground->slope.x(), -ground->slope.y(), 1.0);
  const double noise_m2 = ground->sd_m * ground->sd_m + kMiddleSd_m * kMiddleSd_m;
  const double variance_m2 = up.dot(P * up) + noise_m2;
  const double off_m = ground->height_m + kMiddle_m - at.height_m;
  if (off_m * off_m > kFar * variance_m2) return std::nullopt;
  const Eigen::Vector3d gain = P * up / variance_m2;
  const Eigen::Matrix3d left = Eigen::Matrix3d::Identity() - gain * up.transpose();
  const Eigen::Matrix3d after =
      left * P * left.transpose() + noise_m2 * gain * gain.transpose();  // stays positive
  return Position{position.p_ecef + R * gain * off_m, R * after * R.transpose()};
}

}  // namespace ols::fusion
