// Analytic lands: the height of the ground is a function of the distances [m] east and north of a
// place.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <utility>

#include "geometry/direction.h"
#include "geometry/wgs84.h"
#include "land/surface.h"

namespace ols::fusion {

inline const Geodetic kPlace{0.84, 0.2, 0.0};

// Heights are above the ellipsoid: flat land follows the curvature of the Earth.
class Land : public land::Surface {
 public:
  using Height = std::function<double(double east_m, double north_m)>;
  explicit Land(Height height, double sd_m = 1.0, const Geodetic& place = kPlace)
      : frame_(place), height_(std::move(height)), sd_m_(sd_m) {}

  std::optional<land::SurfaceHeight> ground(double latitude_rad,
                                            double longitude_rad) const override {
    const Eigen::Vector3d p = frame_.to_enu(ecef_from_geodetic({latitude_rad, longitude_rad, 0.0}));
    if (p.norm() > 15e3) return std::nullopt;
    return land::SurfaceHeight{height_(p.x(), p.y()), sd_m_};
  }
  std::optional<land::SurfaceHeight> top(double latitude_rad, double longitude_rad) const override {
    return ground(latitude_rad, longitude_rad);
  }
  // The ECEF position at this height above the ellipsoid.
  Eigen::Vector3d at(double east_m, double north_m, double height_m) const {
    Geodetic place = geodetic_from_ecef(frame_.to_ecef({east_m, north_m, 0.0}));
    place.height_m = height_m;
    return ecef_from_geodetic(place);
  }
  Eigen::Vector3d on_ground(double east_m, double north_m, double above_m = 0.0) const {
    return at(east_m, north_m, height_(east_m, north_m) + above_m);
  }

 private:
  LocalFrame frame_;
  Height height_;
  double sd_m_;
};

inline double flat(double, double) { return 0.0; }
// A wall 500 m to the east, 50 m high and 20 m thick.
inline double ridge(double east_m, double) { return std::abs(east_m - 500.0) < 10.0 ? 50.0 : 0.0; }

inline Eigen::Matrix3d enu_covariance(const Eigen::Vector3d& p_ecef, const Eigen::Vector3d& sd_m) {
  const Eigen::Matrix3d R = R_ecef_enu(p_ecef);
  return R * sd_m.cwiseAbs2().asDiagonal() * R.transpose();
}

}  // namespace ols::fusion
