// Stations and targets at known positions.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "central/measurement/bearing_measurement.h"
#include "central/measurement/ray.h"
#include "geometry/angles.h"
#include "geometry/wgs84.h"

namespace ols::fusion::test {

inline const LocalFrame& site() {
  static const LocalFrame frame({radians(49.2), radians(16.6), 250.0});
  return frame;
}

// Direction from a camera centre to a point, in the horizon at the camera centre.
inline AzimuthElevation direction_to(const Eigen::Vector3d& from_ecef,
                                     const Eigen::Vector3d& to_ecef) {
  return azimuth_elevation_from_enu(R_ecef_enu(from_ecef).transpose() * (to_ecef - from_ecef));
}

// An exact ray between two points of the site [m, site's east-north-up].
inline Ray ray_to(const std::string& station, const Eigen::Vector3d& from_enu,
                  const Eigen::Vector3d& to_enu, double sigma_rad = 1e-4) {
  Ray ray;
  ray.station = station;
  ray.sight.origin_ecef = site().to_ecef(from_enu);
  ray.sight.direction = direction_to(ray.sight.origin_ecef, site().to_ecef(to_enu));
  ray.sight.covariance_white = Eigen::Matrix2d::Identity() * (sigma_rad * sigma_rad);
  ray.rate_covariance = Eigen::Matrix2d::Identity() * 1e-8;
  return ray;
}

// The ray, turned by small angles in cross-elevation and elevation.
inline Ray turned(Ray ray, double cross_elevation_rad, double elevation_rad) {
  ray.sight.direction.elevation_rad += elevation_rad;
  ray.sight.direction.azimuth_rad =
      wrap_two_pi(ray.sight.direction.azimuth_rad +
                  cross_elevation_rad / std::cos(ray.sight.direction.elevation_rad));
  return ray;
}

inline BearingMeasurement measurement_of(const Ray& ray, std::int64_t utime_us) {
  BearingMeasurement measurement;
  measurement.station = ray.station;
  measurement.utime_us = utime_us;
  measurement.sight = ray.sight;
  return measurement;
}

inline const std::vector<Eigen::Vector3d>& square() {
  static const std::vector<Eigen::Vector3d> places = {
      {-200.0, -200.0, 0.0}, {200.0, -200.0, 3.0}, {200.0, 200.0, -2.0}, {-200.0, 200.0, 5.0}};
  return places;
}

inline std::vector<Ray> rays_from(const std::vector<Eigen::Vector3d>& places,
                                  const Eigen::Vector3d& target_enu, double sigma_rad = 1e-4) {
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < places.size(); ++i) {
    rays.push_back(
        ray_to(std::string(1, static_cast<char>('a' + i)), places[i], target_enu, sigma_rad));
  }
  return rays;
}

}  // namespace ols::fusion::test
