// Lands whose heights are given by a formula, and the directions in which their points are seen, by
// exact geometry.
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "geometry/angles.h"
#include "geometry/direction.h"
#include "geometry/wgs84.h"
#include "land/surface.h"

namespace ols::land {

class MadeLand : public Surface {
 public:
  using Heights = std::function<std::optional<double>(double latitude_rad, double longitude_rad)>;
  explicit MadeLand(Heights heights, double sd_m = 0.0)
      : heights_(std::move(heights)), sd_m_(sd_m) {}
  std::optional<SurfaceHeight> ground(double latitude_rad, double longitude_rad) const override {
    const auto height_m = heights_(latitude_rad, longitude_rad);
    if (!height_m) return std::nullopt;
    return SurfaceHeight{*height_m, sd_m_};
  }
  std::optional<SurfaceHeight> top(double latitude_rad, double longitude_rad) const override {
    return ground(latitude_rad, longitude_rad);
  }

 private:
  Heights heights_;
  double sd_m_;
};

struct Seen {
  AzimuthElevation direction;  // apparent
  double range_m = 0.0, distance_m = 0.0;
};

inline Seen see(const LocalFrame& camera, const Geodetic& place, double refraction_k = 0.13) {
  const Eigen::Vector3d enu = camera.to_enu(ecef_from_geodetic(place));
  const double distance_m = enu.head<2>().norm();
  const Eigen::Vector3d lifted =
      enu + refraction_k * distance_m * distance_m / (2.0 * 6'371'000.0) * Eigen::Vector3d::UnitZ();
  return {azimuth_elevation_from_enu(lifted), enu.norm(), distance_m};
}

// The place at this azimuth and horizontal distance from a camera, `height_m` above the ellipsoid.
inline Geodetic place_at(const LocalFrame& camera, double azimuth_rad, double distance_m,
                         double height_m) {
  Geodetic place = camera.origin();
  for (int i = 0; i < 4; ++i) {  // converges to the exact distance and azimuth at that height
    place.height_m = height_m;
    const Eigen::Vector3d enu = camera.to_enu(ecef_from_geodetic(place));
    const Eigen::Vector3d wanted(std::sin(azimuth_rad) * distance_m,
                                 std::cos(azimuth_rad) * distance_m, enu.z());
    place = geodetic_from_ecef(camera.to_ecef(wanted));
  }
  place.height_m = height_m;
  return place;
}

}  // namespace ols::land
