// Computes the line of sight and its covariance from a pixel and the PTU angles; also the inverse.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "geometry/direction.h"
#include "geometry/kinematic_chain.h"
#include "geometry/lens.h"
#include "geometry/wgs84.h"

namespace ols {

// Calibration errors, 1-sigma. They are systematic: the same in every frame.
struct CalibrationSd {
  double heading_rad = 0.0;
  double tilt_rad = 0.0;        // for each of the two axes of ORIGIN
  double mount_rad = 0.0;       // of the camera, about each axis perpendicular to the optical axis
  double mount_roll_rad = 0.0;  // about the optical axis
  double position_m = 0.0;      // of the station, for each of east, north, up
};

// A station's calibrated geometry.
struct StationGeometry {
  Geodetic position;  // the origin of GROUND
  ChainParameters chain;
  CameraIntrinsics camera;
  CalibrationSd sd;
};

// One measured pixel with the PTU angles at its exposure.
struct PixelSight {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Zero();  // white
  // The same in every frame: from the lens; and 1-sigma of each coordinate from the designation
  Eigen::Matrix2d covariance_systematic_px2 = Eigen::Matrix2d::Zero();
  double aim_sd_px = 0.0;
  PanTilt angles;
  Eigen::Matrix2d angles_covariance_rad2 = Eigen::Matrix2d::Zero();  // white, (pan, tilt)
  Eigen::Matrix2d angles_systematic_rad2 = Eigen::Matrix2d::Zero();  // the same in every frame
};

// The line of sight of a pixel, with first-order covariances; nullopt when the pixel cannot be
// unprojected.
std::optional<LineOfSight> sight(const StationGeometry& station, const PixelSight& measurement);

// A point seen by a station.
struct View {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double distance_m = 0.0;  // from the camera centre
};

// The inverse of sight() at given PTU angles: the pixel of a point; nullopt when the point is
// behind the camera.
std::optional<View> view(const StationGeometry& station, const PanTilt& angles,
                         const Eigen::Vector3d& p_ecef);

// The inverse of sight() with free PTU angles: the angles that put the point on the given pixel
// (default: where the optical axis meets the image). The lever arms of the chain are included.
// nullopt when no pan and tilt reach the point.
std::optional<PanTilt> aim_at(const StationGeometry& station, const Eigen::Vector3d& p_ecef,
                              const std::optional<Eigen::Vector2d>& pixel = std::nullopt);

// The PTU angles that point the optical axis in a direction at infinity, relative to the horizon at
// the camera centre.
std::optional<PanTilt> aim_along(const StationGeometry& station, const AzimuthElevation& direction);

// The direction of the optical axis, relative to the horizon at the camera centre.
AzimuthElevation optical_axis(const StationGeometry& station, const PanTilt& angles);

// Camera centre in ECEF [m].
Eigen::Vector3d camera_centre_ecef(const StationGeometry& station, const PanTilt& angles);

// Homography K R_2 R_1^T K^-1: maps pixels of a frame exposed at PTU angles `from` to pixels of a
// frame exposed at `to`. It holds for points at infinity, without distortion.
Eigen::Matrix3d rotation_homography(const StationGeometry& station, const PanTilt& from,
                                    const PanTilt& to);

}  // namespace ols
