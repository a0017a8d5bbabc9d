// Directions in a local east-north-up frame, and their tangent plane.
//
// Azimuth is measured clockwise from true north, and elevation from the local horizontal plane
// upwards. Small errors of a direction are given on the tangent plane at that direction. The axes
// of this plane (cross-elevation, elevation) point in the direction of increasing azimuth and of
// increasing elevation. A small angle in cross-elevation is the angle in azimuth times
// cos(elevation).
#pragma once

#include <Eigen/Core>

namespace ols {

struct AzimuthElevation {
  double azimuth_rad = 0.0;    // 0..2 pi, clockwise from true north
  double elevation_rad = 0.0;  // -pi/2..pi/2
};

// The unit vector of a direction, east-north-up.
Eigen::Vector3d enu_from_azimuth_elevation(const AzimuthElevation& direction);

// The inverse of enu_from_azimuth_elevation(), for any non-zero vector. At the zenith and nadir the
// azimuth is 0.
AzimuthElevation azimuth_elevation_from_enu(const Eigen::Vector3d& v_enu);

// 3x2: the axes of the tangent plane. The columns are the unit vectors of increasing
// cross-elevation and elevation, orthogonal to the direction and to each other.
Eigen::Matrix<double, 3, 2> tangent_basis(const AzimuthElevation& direction);

// 2x3: multiplied by a small rotation vector [rad], gives the shift [rad] of a direction on its
// tangent plane. `tangent`: the axes of this plane (tangent_basis()), in the same frame as the
// rotation vector.
Eigen::Matrix<double, 2, 3> shift_by_rotation(const Eigen::Matrix<double, 3, 2>& tangent);

// Angle between two vectors [rad]; accurate even for tiny angles.
double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

// A measured line of sight: the complete geometry of one bearing.
struct LineOfSight {
  Eigen::Vector3d origin_ecef = Eigen::Vector3d::Zero();  // [m] camera centre
  AzimuthElevation direction;                             // relative to the horizon at origin_ecef
  // Covariances [rad^2] on the tangent plane, order (cross-elevation, elevation).
  Eigen::Matrix2d covariance_white = Eigen::Matrix2d::Zero();       // independent in every frame
  Eigen::Matrix2d covariance_systematic = Eigen::Matrix2d::Zero();  // the same in every frame
  Eigen::Vector3d origin_sd_enu_m = Eigen::Vector3d::Zero();        // [m] the same in every frame
  // The aim's contribution to covariance_systematic, as a 1-sigma of each axis. The aim is the
  // offset of the followed point from the target's middle. It is constant in metres; as an angle,
  // it changes with the range.
  double aim_sd_rad = 0.0;
};

// The unit vector of a line of sight, in ECEF components.
Eigen::Vector3d direction_ecef(const LineOfSight& sight);

}  // namespace ols
