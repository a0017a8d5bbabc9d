// Computes the line of sight and its covariance from a pixel and the PTU angles, and the pixel or
// the angles for a given point.
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
  double tilt_rad = 0.0;        // of each of the two horizontal axes of ORIGIN
  double mount_rad = 0.0;       // of the camera, about each axis perpendicular to the optical axis
  double mount_roll_rad = 0.0;  // about the optical axis
  double position_m = 0.0;      // of the station, each of east, north, up
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
  // Errors that are the same in every frame: the covariance of those that the lens causes, and
  // (aim_sd_px) the 1-sigma, in each coordinate, of the error that the designation causes.
  Eigen::Matrix2d covariance_systematic_px2 = Eigen::Matrix2d::Zero();
  double aim_sd_px = 0.0;
  PanTilt angles;
  Eigen::Matrix2d angles_covariance_rad2 = Eigen::Matrix2d::Zero();  // white, (pan, tilt)
  Eigen::Matrix2d angles_systematic_rad2 = Eigen::Matrix2d::Zero();  // the same in every frame
};

// The line of sight of a pixel, with first-order covariances. nullopt if the pixel cannot be
// unprojected.
std::optional<LineOfSight> sight(const StationGeometry& station, const PixelSight& measurement);

// A point seen by a station.
struct View {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double distance_m = 0.0;  // from the camera centre
};

// The inverse of sight() at given PTU angles: the pixel of a point. nullopt if the point is behind
// the camera.
std::optional<View> view(const StationGeometry& station, const PanTilt& angles,
                         const Eigen::Vector3d& p_ecef);

// The inverse of sight() for a given pixel: the PTU angles at which the point appears at this pixel
// (default: where the optical axis meets the image). The lever arms of the chain are included.
// nullopt if no pan and tilt angles reach the point.
std::optional<PanTilt> aim_at(const StationGeometry& station, const Eigen::Vector3d& p_ecef,
                              const std::optional<Eigen::Vector2d>& pixel = std::nullopt);

// The PTU angles at which the optical axis points in this direction (relative to the horizon at the
// camera centre). nullopt if no pan and tilt angles reach this direction.
std::optional<PanTilt> aim_along(const StationGeometry& station, const AzimuthElevation& direction);

// The direction of the optical axis, relative to the horizon at the camera centre.
AzimuthElevation optical_axis(const StationGeometry& station, const PanTilt& angles);

// Camera centre in ECEF [m].
Eigen::Vector3d camera_centre_ecef(const StationGeometry& station, const PanTilt& angles);

// Homography K R_2 R_1^T K^-1: maps pixels of a frame exposed at the PTU angles `from` to pixels of
// a frame exposed at the PTU angles `to`. It is valid for points at infinity and a lens without
// distortion.
Eigen::Matrix3d rotation_homography(const StationGeometry& station, const PanTilt& from,
                                    const PanTilt& to);

}  // namespace ols
