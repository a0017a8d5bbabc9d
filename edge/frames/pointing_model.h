// Converts between directions and PTU angles, with the station's position and tilt, the PTU's
// reported angles, its calibrated errors, and its travel. Pure.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "edge/calibration/calibrated_unit.h"
#include "edge/mount/angle_history.h"
#include "edge/mount/limits.h"
#include "edge/station/station_config.h"
#include "edge/station/station_types.h"
#include "edge/video/video_frame.h"

namespace ols::station {

// The unit at one instant.
struct UnitAngles {
  PanTilt angles;  // for the chain; of a calibrated unit, corrected for its errors
  PanTilt reported;
  PanTilt rate;                // [rad/s]
  Eigen::Matrix2d covariance;  // [rad^2] (pan, tilt), white
  bool interpolated = false;   // false: the instant lies after the newest sample
  UnitReading reading;         // of a calibrated unit
  double time_s = 0.0;
};

// "Reported" angles are the unit's own: those of its samples, goals and limits. All other angles
// are the chain's. Without a calibration both are the same.
class PointingModel {
 public:
  // The pose is the configured one until set_pose().
  explicit PointingModel(const StationConfig& config);

  void set_pose(const sensors::StationPose& pose);
  void set_limits(const mount::Limits& limits);
  // In time order.
  void add(const mount::AngleSample& sample);
  // Takes a zoom position of a motorised lens. geometry() has the camera at the newest position.
  void add(const lens::ZoomSample& sample);
  void set_lens(const lens::ByAxis<std::optional<double>>& positions) { lens_ = positions; }
  const lens::ByAxis<std::optional<double>>& lens() const { return lens_; }
  // Call when the unit's zero may have changed: discards all earlier angles.
  void forget_angles();

  // Uses another geometry from now on, with or without a calibration. The pose is that of the
  // geometry.
  void use(const StationGeometry& geometry, const std::optional<StationCalibration>& calibration);
  // Adds these errors to those of the calibration's setup. No effect without a calibration.
  void doubt_setup(double heading_sd_rad, double tilt_sd_rad);
  // Whether a calibration is in use. It is not in use while the size of the unit's counts differs
  // from the calibrated size.
  bool calibrated() const { return unit_ && unit_->fits(); }

  // With the present pose.
  const StationGeometry& geometry() const { return geometry_; }
  const sensors::StationPose& pose() const { return pose_; }
  // Incremented when the pose has changed by more than its sigmas; 0: as configured.
  std::int64_t pose_revision() const { return pose_revision_; }

  std::optional<UnitAngles> angles_at(double time_s) const;
  // The time of the newest sample; 0 before the first.
  PanTilt angles_now() const;
  std::optional<mount::AngleSample> newest_angles() const { return history_.newest(); }
  std::optional<PanTilt> reported_angles() const {
    const auto newest = history_.newest();
    return newest ? std::optional(newest->angles) : std::nullopt;
  }
  // Where the camera is and looks at an instant; nullopt: the unit's angles are not known.
  std::optional<video::CameraView> camera_at(double time_s) const;
  // The camera with its deviations at an instant; nullopt: the zoom is not known.
  std::optional<ZoomPoint> zoom_at(double time_s) const;
  // Reported angles that bring a pixel of this instant to the middle of the picture. The travel is
  // ignored.
  std::optional<PanTilt> centring(const Eigen::Vector2d& pixel, double time_s) const;
  // Maps pixels at one instant to pixels at another, for a scene at infinity.
  std::optional<Eigen::Matrix3d> homography(double from_s, double to_s) const;
  // The line of sight of a pixel, from the unit's angles and their covariance.
  std::optional<LineOfSight> sight(PixelSight pixel, const UnitAngles& unit) const;
  // The pixel of a direction at infinity.
  std::optional<Eigen::Vector2d> pixel_of(const PanTilt& angles,
                                          const AzimuthElevation& direction) const;
  bool in_picture(const Eigen::Vector2d& pixel) const;

  // Converts reported angles to the angles of the same direction that the unit reaches by the
  // shortest way, from its position or from `here`. nullopt: it cannot point there.
  std::optional<PanTilt> reachable(const PanTilt& angles) const;
  std::optional<PanTilt> reachable_from(const PanTilt& here, PanTilt angles) const;
  // The reported angles that put a direction on the optical axis; nullopt: the unit cannot point
  // there. The second form ignores the travel, and assumes that the unit comes from the reported
  // angles `here`.
  std::optional<PanTilt> aim(const AzimuthElevation& direction) const;
  std::optional<PanTilt> aim_from(const PanTilt& here, const AzimuthElevation& direction) const;

 private:
  StationGeometry geometry_;
  sensors::StationPose pose_;
  sensors::StationPose revision_pose_;  // the pose of pose_revision()
  std::int64_t pose_revision_ = 0;
  mount::Limits limits_;
  mount::AngleHistory history_;
  std::optional<CalibratedUnit> unit_;
  std::optional<lens::ZoomLens> zoom_;
  lens::ByAxis<std::optional<double>> lens_;  // positions of all axes
};

}  // namespace ols::station
