// Directions in a local east-north-up frame, and their tangent plane.
//
// Azimuth is clockwise from true north, elevation above the local horizontal plane. Small errors of
// a direction are given on the tangent plane at that direction. The plane's axes (cross-elevation,
// elevation) are the unit vectors of growing azimuth and of growing elevation. Cross-elevation is
// azimuth times cos(elevation).
#pragma once

#include <Eigen/Core>

namespace ols {

struct AzimuthElevation {
  double azimuth_rad = 0.0;    // 0..2 pi, clockwise from true north
  double elevation_rad = 0.0;  // -pi/2..pi/2
};

// Unit vector, east-north-up.
Eigen::Vector3d enu_from_azimuth_elevation(const AzimuthElevation& direction);

// The inverse of enu_from_azimuth_elevation(), for any non-zero vector. At the zenith and nadir the
// azimuth is 0.
AzimuthElevation azimuth_elevation_from_enu(const Eigen::Vector3d& v_enu);

// 3x2: the columns are the unit vectors of growing cross-elevation and elevation, orthogonal to the
// direction and to each other.
Eigen::Matrix<double, 3, 2> tangent_basis(const AzimuthElevation& direction);

// 2x3: multiplied by a small rotation vector [rad], gives the shift of a direction on its tangent
// plane. The rotation vector is in the same frame as `tangent`.
Eigen::Matrix<double, 2, 3> shift_by_rotation(const Eigen::Matrix<double, 3, 2>& tangent);

// Angle between two vectors [rad]; exact for tiny angles too.
double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

// A measured line of sight: the complete geometry of one bearing.
struct LineOfSight {
  Eigen::Vector3d origin_ecef = Eigen::Vector3d::Zero();  // [m] camera centre
  AzimuthElevation direction;                             // relative to the horizon at origin_ecef
  // Covariances [rad^2] on the tangent plane, order (cross-elevation, elevation).
  Eigen::Matrix2d covariance_white = Eigen::Matrix2d::Zero();       // independent in every frame
  Eigen::Matrix2d covariance_systematic = Eigen::Matrix2d::Zero();  // the same in every frame
  Eigen::Vector3d origin_sd_enu_m = Eigen::Vector3d::Zero();        // [m] the same in every frame
  // The part of covariance_systematic that comes from the aim, 1-sigma of each axis. The aim is the
  // offset of the followed point from the target's middle: constant in metres, not as an angle.
  double aim_sd_rad = 0.0;
};

// Unit vector of a line of sight in ECEF.
Eigen::Vector3d direction_ecef(const LineOfSight& sight);

}  // namespace ols
