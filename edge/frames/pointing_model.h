// Converts between directions and PTU angles. It uses the station's position and tilt, and the
// unit's reported angles, calibrated errors and travel limits. Pure.
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
  PanTilt angles;  // angles of the kinematic chain; for a calibrated unit, corrected for its errors
  PanTilt reported;
  PanTilt rate;                // [rad/s]
  Eigen::Matrix2d covariance;  // [rad^2] (pan, tilt), white part
  // [rad^2] of errors that are the same in every frame.
  Eigen::Matrix2d lasting_covariance = Eigen::Matrix2d::Zero();
  bool interpolated = false;  // false if the time is after the newest sample
  UnitReading reading;        // set for a calibrated unit
  double time_s = 0.0;
};

// Reported angles are the unit's own; its samples, goals and limits use them. All other angles are
// those of the kinematic chain. Without a calibration, the two are the same.
class PointingModel {
 public:
  // Until set_pose(), the pose is the configured one.
  explicit PointingModel(const StationConfig& config);

  void set_pose(const sensors::StationPose& pose);
  void set_limits(const mount::Limits& limits);
  // Adds a sample; call it in order of time.
  void add(const mount::AngleSample& sample);
  // Adds the motion of the image between an earlier frame, exposed at `from_s`, and `frame`.
  // Returns the turn of the mount that causes this motion; nullopt if the motion is not used.
  std::optional<mount::SeenTurn> add(const tracker::ImageMotion& motion, double from_s,
                                     const camera::Frame& frame);
  // Adds a zoom position of a motorised lens. geometry() contains the camera at the newest
  // position.
  void add(const lens::ZoomSample& sample);
  void set_lens(const lens::ByAxis<std::optional<double>>& positions) { lens_ = positions; }
  const lens::ByAxis<std::optional<double>>& lens() const { return lens_; }
  // Discards all earlier angles. Call it when the unit's zero may have changed.
  void forget_angles();
  // Discards from which side each axis has come. Call it when the unit may have moved unseen.
  void forget_approach() { approach_.clear(); }

  // Uses this geometry from now on. The pose becomes that of the geometry. `calibration`: the
  // calibration from which the geometry comes, if any.
  void use(const StationGeometry& geometry, const std::optional<StationCalibration>& calibration);
  // Adds these errors to those of the calibration's setup. Without a calibration, this has no
  // effect.
  void doubt_setup(double heading_sd_rad, double tilt_sd_rad);
  // Whether a calibration is in use. It is not used while the size of the unit's counts differs
  // from the calibrated one.
  bool calibrated() const { return unit_ && unit_->fits(); }

  // The geometry with the present pose.
  const StationGeometry& geometry() const { return geometry_; }
  const sensors::StationPose& pose() const { return pose_; }
  // 0 at the start. Is incremented when the pose changes by more than its sigmas, or when geometry
  // or setup change.
  std::int64_t pose_revision() const { return pose_revision_; }

  // The unit's state at a time. `stamp_sd_s`: 1-sigma of this time, if it is the time stamp of a
  // picture; the covariance includes its effect.
  std::optional<UnitAngles> angles_at(double time_s, double stamp_sd_s = 0.0) const;
  // The unit's readings at an instant. nullopt if the unit has not reported angles before and after
  // the instant, or has not reported the size of its counts.
  std::optional<ExposedCounts> counts_at(double time_s) const;
  // The angles at the time of the newest sample; 0 before the first sample.
  PanTilt angles_now() const;
  std::optional<mount::AngleSample> newest_angles() const { return angles_.reported().newest(); }
  std::optional<PanTilt> reported_angles() const {
    const auto newest = newest_angles();
    return newest ? std::optional(newest->angles) : std::nullopt;
  }
  // The camera's position and direction with these angles; nullopt if the zoom is unknown.
  std::optional<video::CameraView> camera_at(const UnitAngles& unit) const;
  // The camera's focal length and principal point at a time, with their standard deviations;
  // nullopt if the zoom is unknown.
  std::optional<ZoomPoint> zoom_at(double time_s) const;
  // Whether the zoom was at rest at a time; always true for a lens without a motor. nullopt if its
  // positions before and after that time are unknown.
  std::optional<bool> zoom_rests(double time_s) const {
    return zoom_ ? zoom_->rests_at(time_s) : std::optional(true);
  }
  // The reported angles that bring the object at a pixel, seen at this time, to the middle of the
  // picture. Travel limits are ignored.
  std::optional<PanTilt> centring(const Eigen::Vector2d& pixel, double time_s) const;
  // Maps pixels at one time to pixels at another, for a scene at infinity. It is computed from the
  // unit's reported angles alone.
  std::optional<Eigen::Matrix3d> homography(double from_s, double to_s) const;
  // Maps the pixel of a star at one time to its pixel at another. It is computed from the unit's
  // reported angles and the Earth's rotation.
  std::optional<Eigen::Matrix3d> star_motion(double from_s, double to_s) const;
  // The line of sight of a pixel, computed from the unit's angles and their covariance.
  std::optional<LineOfSight> sight(PixelSight pixel, const UnitAngles& unit) const;
  // The pixel at which an object at infinity in this direction appears.
  std::optional<Eigen::Vector2d> pixel_of(const PanTilt& angles,
                                          const AzimuthElevation& direction) const;
  bool in_picture(const Eigen::Vector2d& pixel) const;

  // Pan angles that differ by a whole turn point in the same direction. Of all reported angles that
  // point in the same direction as `angles`, these functions return the ones at the end of the
  // unit's shortest path. The path starts at the unit's present position, or at `here`. nullopt if
  // the unit cannot point in this direction.
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
  sensors::StationPose revision_pose_;  // the pose at the last change of pose_revision()
  std::int64_t pose_revision_ = 0;
  mount::Limits limits_;
  mount::MountAngles angles_;
  std::optional<PanTilt> last_angles_;  // at which a turn of the image was seen
  mount::ApproachHistory approach_;
  std::optional<CalibratedUnit> unit_;
  std::optional<lens::ZoomLens> zoom_;
  lens::ByAxis<std::optional<double>> lens_;  // positions of all axes
};

}  // namespace ols::station
