// Converts between directions and PTU angles. It uses the station's position and tilt, the unit's
// reported angles, its calibrated errors, and its travel limits. Pure.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "edge/calibration/calibrated_unit.h"
#include "edge/camera/frame.h"
#include "edge/frames/exposed_counts.h"
#include "edge/mount/approach_history.h"
#include "edge/mount/limits.h"
#include "edge/mount/mount_angles.h"
#include "edge/station/station_config.h"
#include "edge/station/station_types.h"
#include "edge/tracker/image_motion.h"
#include "edge/video/video_frame.h"

namespace ols::station {

// The unit's state at one instant.
struct UnitAngles {
  PanTilt angles;  // for the chain; for a calibrated unit, corrected for its errors
  PanTilt reported;
  PanTilt rate;                                                  // [rad/s]
  Eigen::Matrix2d covariance;                                    // [rad^2] (pan, tilt), white
  Eigen::Matrix2d lasting_covariance = Eigen::Matrix2d::Zero();  // [rad^2] the same in every frame
  bool interpolated = false;  // false if the instant is after the newest sample
  UnitReading reading;        // set for a calibrated unit
  double time_s = 0.0;
};

// "Reported" angles are the unit's own: its samples, goals and limits use them. All other angles
// belong to the kinematic chain. Without a calibration the two are the same.
class PointingModel {
 public:
  // Until set_pose(), the pose is the configured one.
  explicit PointingModel(const StationConfig& config);

  void set_pose(const sensors::StationPose& pose);
  void set_limits(const mount::Limits& limits);
  // Call in order of time.
  void add(const mount::AngleSample& sample);
  // Takes the motion that a frame shows since an earlier one, exposed at from_s.
  void add(const tracker::ImageMotion& motion, double from_s, const camera::Frame& frame);
  // Takes a zoom position of a motorised lens. geometry() contains the camera at the newest
  // position.
  void add(const lens::ZoomSample& sample);
  void set_lens(const lens::ByAxis<std::optional<double>>& positions) { lens_ = positions; }
  const lens::ByAxis<std::optional<double>>& lens() const { return lens_; }
  // Discards all earlier angles. Call it when the unit's zero may have changed.
  void forget_angles();

  // Uses this geometry from now on, with or without a calibration. The pose becomes that of the
  // geometry.
  void use(const StationGeometry& geometry, const std::optional<StationCalibration>& calibration);
  // Adds these errors to those of the calibration's setup. This has no effect without a
  // calibration.
  void doubt_setup(double heading_sd_rad, double tilt_sd_rad);
  // Whether a calibration is in use. It is not in use while the size of the unit's counts differs
  // from the calibrated one.
  bool calibrated() const { return unit_ && unit_->fits(); }

  // The geometry with the present pose.
  const StationGeometry& geometry() const { return geometry_; }
  const sensors::StationPose& pose() const { return pose_; }
  // Incremented when the pose has changed by more than its sigmas; 0 while it is the configured
  // one.
  std::int64_t pose_revision() const { return pose_revision_; }

  // `stamp_sd_s`: 1-sigma of an instant that is a picture's stamp; the covariance includes it.
  std::optional<UnitAngles> angles_at(double time_s, double stamp_sd_s = 0.0) const;
  // nullopt if the unit has not reported angles before and after the instant, or the size of its
  // counts.
  std::optional<ExposedCounts> counts_at(double time_s) const;
  // The angles at the time of the newest sample; 0 before the first sample.
  PanTilt angles_now() const;
  std::optional<mount::AngleSample> newest_angles() const { return angles_.reported().newest(); }
  std::optional<PanTilt> reported_angles() const {
    const auto newest = newest_angles();
    return newest ? std::optional(newest->angles) : std::nullopt;
  }
  // The camera's position and direction with these angles; nullopt if the zoom is not known.
  std::optional<video::CameraView> camera_at(const UnitAngles& unit) const;
  // The camera with its deviations at an instant; nullopt if the zoom is not known.
  std::optional<ZoomPoint> zoom_at(double time_s) const;
  // Whether the zoom stood still at an instant, as a lens without a motor always does; nullopt if
  // its positions before and after are not known.
  std::optional<bool> zoom_rests(double time_s) const {
    return zoom_ ? zoom_->rests_at(time_s) : std::optional(true);
  }
  // The reported angles that bring a pixel of this instant to the middle of the picture. Travel
  // limits are ignored.
  std::optional<PanTilt> centring(const Eigen::Vector2d& pixel, double time_s) const;
  // Maps pixels at one instant to pixels at another, for a scene at infinity, by the unit's reports
  // alone.
  std::optional<Eigen::Matrix3d> homography(double from_s, double to_s) const;
  // Maps the pixel of a star at one instant to its pixel at another, by the unit's reports and the
  // earth's rotation.
  std::optional<Eigen::Matrix3d> star_motion(double from_s, double to_s) const;
  // The line of sight of a pixel, computed from the unit's angles and their covariance.
  std::optional<LineOfSight> sight(PixelSight pixel, const UnitAngles& unit) const;
  // The pixel of a direction at infinity.
  std::optional<Eigen::Vector2d> pixel_of(const PanTilt& angles,
                                          const AzimuthElevation& direction) const;
  bool in_picture(const Eigen::Vector2d& pixel) const;

  // Converts reported angles to the angles of the same direction that the unit reaches by the
  // shortest way, from its present position or from `here`. nullopt if the unit cannot point there.
  std::optional<PanTilt> reachable(const PanTilt& angles) const;
  std::optional<PanTilt> reachable_from(const PanTilt& here, PanTilt angles) const;
  // The reported angles that put a direction on the optical axis; nullopt if the unit cannot point
  // there. aim_from() ignores the travel limits, and assumes that the unit comes from the reported
  // angles `here`.
  std::optional<PanTilt> aim(const AzimuthElevation& direction) const;
  std::optional<PanTilt> aim_from(const PanTilt& here, const AzimuthElevation& direction) const;

 private:
  UnitAngles unit_angles(const mount::AngleAt& at, double time_s) const;

  StationGeometry geometry_;
  sensors::StationPose pose_;
  sensors::StationPose revision_pose_;  // the pose that belongs to pose_revision()
  std::int64_t pose_revision_ = 0;
  mount::Limits limits_;
  mount::MountAngles angles_;
  mount::ApproachHistory approach_;
  std::optional<CalibratedUnit> unit_;
  std::optional<lens::ZoomLens> zoom_;
  lens::ByAxis<std::optional<double>> lens_;  // positions of all axes
};

}  // namespace ols::station
