#include "geometry/direction.h"

#include <Eigen/Geometry>
#include <cmath>

#include "geometry/angles.h"
#include "geometry/wgs84.h"

namespace ols {

Eigen::Vector3d enu_from_azimuth_elevation(const AzimuthElevation& direction) {
  const double horizontal = std::cos(direction.elevation_rad);
  return {horizontal * std::sin(direction.azimuth_rad),
          horizontal * std::cos(direction.azimuth_rad), std::sin(direction.elevation_rad)};
}

AzimuthElevation azimuth_elevation_from_enu(const Eigen::Vector3d& v_enu) {
  const double horizontal = std::hypot(v_enu.x(), v_enu.y());
  const double azimuth_rad = horizontal > 0.0 ? wrap_two_pi(std::atan2(v_enu.x(), v_enu.y())) : 0.0;
  return {azimuth_rad, std::atan2(v_enu.z(), horizontal)};
}

Eigen::Matrix<double, 3, 2> tangent_basis(const AzimuthElevation& direction) {
  const double sin_azimuth = std::sin(direction.azimuth_rad);
  const double cos_azimuth = std::cos(direction.azimuth_rad);
  const double sin_elevation = std::sin(direction.elevation_rad);
  Eigen::Matrix<double, 3, 2> basis;
  basis.col(0) << cos_azimuth, -sin_azimuth, 0.0;
  basis.col(1) << -sin_elevation * sin_azimuth, -sin_elevation * cos_azimuth,
      std::cos(direction.elevation_rad);
  return basis;
}

// Rotated by r a direction moves by r x d. With the tangent (right, up): right . (r x d) =
// r . (d x right) = -r . up, and up . (r x d) = r . right.
Eigen::Matrix<double, 2, 3> shift_by_rotation(const Eigen::Matrix<double, 3, 2>& tangent) {
  Eigen::Matrix<double, 2, 3> result;
  result << -tangent.col(1).transpose(), tangent.col(0).transpose();
  return result;
}

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

Eigen::Vector3d direction_ecef(const LineOfSight& sight) {
  return R_ecef_enu(sight.origin_ecef) * enu_from_azimuth_elevation(sight.direction);
}

}  // namespace ols
