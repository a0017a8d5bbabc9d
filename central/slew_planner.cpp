#include "central/slew_planner.h"

#include <algorithm>
#include <cmath>

#include "geometry/wgs84.h"

namespace ols {

Slew plan_slew(const Estimate& target, std::int64_t epoch_us, std::int64_t now_us,
               const Eigen::Vector3d& camera_ecef, const SlewConfig& config) {
  Slew slew;
  slew.utime_us = now_us;
  slew.lease_s = config.lease_s;
  slew.effect_utime_us = now_us + std::llround(config.lead_s * 1e6);
  const double ahead_s = static_cast<double>(slew.effect_utime_us - epoch_us) * 1e-6;
  const bool moving = target.velocity_ecef.allFinite();
  const Eigen::Vector3d velocity =
      moving ? target.velocity_ecef : Eigen::Vector3d(Eigen::Vector3d::Zero());
  const Eigen::Vector3d position = target.position_ecef + velocity * ahead_s;
  Eigen::Matrix3d covariance = target.covariance_ecef;
  if (moving) covariance += target.velocity_covariance_ecef * (ahead_s * ahead_s);
  const double spread_m = 0.5 * config.acceleration_sd_m_s2 * ahead_s * ahead_s;
  covariance.diagonal().array() += spread_m * spread_m;

  const Eigen::Matrix3d R = R_ecef_enu(camera_ecef);
  const Eigen::Vector3d line_enu = R.transpose() * (position - camera_ecef);
  const double range_m = std::max(1e-3, line_enu.norm());
  slew.direction = azimuth_elevation_from_enu(line_enu);
  const Eigen::Matrix<double, 3, 2> tangent = R * tangent_basis(slew.direction);
  const Eigen::Vector2d rate = tangent.transpose() * velocity / range_m;
  // Near the zenith no PTU follows the azimuth; the rate stays finite.
  slew.azimuth_rate_rad_s = rate(0) / std::max(0.01, std::cos(slew.direction.elevation_rad));
  slew.elevation_rate_rad_s = rate(1);
  const Eigen::Matrix2d spread = tangent.transpose() * covariance * tangent;
  slew.direction_sd_rad = std::sqrt(spread.trace() / 2.0) / range_m;
  return slew;
}

}  // namespace ols
