#include "central/measurement/ray.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "base/bus/message_code.h"
#include "geometry/angles.h"
#include "geometry/wgs84.h"

namespace ols::fusion {

RayFrame ray_frame(const LineOfSight& sight) {
  return ray_frame(sight, R_ecef_enu(sight.origin_ecef));
}

RayFrame ray_frame(const LineOfSight& sight, const Eigen::Matrix3d& R) {
  const Eigen::Matrix<double, 3, 2> tangent = R * tangent_basis(sight.direction);
  return {tangent.col(1).cross(tangent.col(0)), tangent};
}

Eigen::Matrix2d stated_covariance(const LineOfSight& sight, double range_m) {
  const Eigen::Matrix<double, 3, 2> tangent_enu = tangent_basis(sight.direction);
  const Eigen::Vector3d variance_enu = sight.origin_sd_enu_m.array().square();
  return sight.covariance_systematic +
         tangent_enu.transpose() * variance_enu.asDiagonal() * tangent_enu / (range_m * range_m);
}

Eigen::Matrix2d systematic_covariance(const Ray& ray, double range_m) {
  const Eigen::Vector2d clock = ray.rate_rad_s * ray.clock_sd_s;
  return stated_covariance(ray.sight, range_m) + clock * clock.transpose();
}

const char* to_string(Solution solution) {
  return word_of_code(code(solution),
                      std::array{"ok", "too-few-rays", "parallel-rays", "behind-camera", "too-far",
                                 "not-converged", "bearing-only", "rays-miss", "ambiguous"});
}

double crossing_angle(const std::vector<Ray>& rays, const std::vector<RayUse>& use) {
  std::vector<Eigen::Vector3d> directions;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (use[i].used) directions.push_back(direction_ecef(rays[i].sight));
  }
  return crossing_angle(directions);
}

double crossing_angle(const std::vector<Eigen::Vector3d>& directions) {
  double greatest = 0.0;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    for (std::size_t j = i + 1; j < directions.size(); ++j) {
      const double angle = angle_between(directions[i], directions[j]);
      greatest = std::max(greatest, std::min(angle, kPi - angle));
    }
  }
  return greatest;
}

}  // namespace ols::fusion
