// Conversion between geographic positions (WGS84, ellipsoidal height), Earth-centred Earth-fixed
// (ECEF) positions and local frames. Computed by GeographicLib (C. Karney).
#pragma once

#include <Eigen/Core>

namespace ols {

struct Geodetic {
  double latitude_rad = 0.0;   // WGS84, -pi/2..pi/2
  double longitude_rad = 0.0;  // WGS84
  double height_m = 0.0;       // above the ellipsoid, never above mean sea level
};

// Earth-centred Earth-fixed position [m].
Eigen::Vector3d ecef_from_geodetic(const Geodetic& position);

// The inverse of ecef_from_geodetic(); accurate to nanometres even far beyond the atmosphere.
Geodetic geodetic_from_ecef(const Eigen::Vector3d& p_ecef);

// The rotation that takes east-north-up components at this position to ECEF components.
Eigen::Matrix3d R_ecef_enu(const Geodetic& position);
Eigen::Matrix3d R_ecef_enu(const Eigen::Vector3d& p_ecef);

// East-north-up frame with its origin at a geographic position.
class LocalFrame {
 public:
  explicit LocalFrame(const Geodetic& origin);

  Eigen::Vector3d to_enu(const Eigen::Vector3d& p_ecef) const;  // [m]
  Eigen::Vector3d to_ecef(const Eigen::Vector3d& p_enu) const;  // [m]
  const Eigen::Matrix3d& R_ecef_enu() const { return R_ecef_enu_; }
  const Eigen::Vector3d& origin_ecef() const { return origin_ecef_; }
  const Geodetic& origin() const { return origin_; }

 private:
  Geodetic origin_;
  Eigen::Vector3d origin_ecef_;
  Eigen::Matrix3d R_ecef_enu_;
};

}  // namespace ols
