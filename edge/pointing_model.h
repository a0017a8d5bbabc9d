// From directions to PTU angles and back: the station's position and tilt, the reported angles of
// the PTU, and its travel. Pure.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "edge/ptu/angle_history.h"
#include "edge/ptu/servo.h"
#include "edge/station_config.h"
#include "edge/station_types.h"

namespace ols::station {

class PointingModel {
 public:
  // The pose is the configured one until set_pose().
  explicit PointingModel(const StationConfig& config);

  void set_pose(const sensors::StationPose& pose);
  void set_limits(const ptu::PtuLimits& limits) { limits_ = limits; }
  // In time order.
  void add(const ptu::AngleSample& sample) { history_.add(sample); }
  // Earlier and later angles are not in the same frame of reference.
  void forget_angles() { history_.clear(); }

  // With the present pose.
  const StationGeometry& geometry() const { return geometry_; }
  const sensors::StationPose& pose() const { return pose_; }
  // Incremented when the pose has changed by more than its sigmas; 0: as configured.
  std::int64_t pose_revision() const { return pose_revision_; }

  std::optional<ptu::AngleAt> angles_at(double time_s) const { return history_.at(time_s); }
  std::optional<ptu::AngleSample> newest_angles() const { return history_.newest(); }
  // Maps pixels at one instant to pixels at another, for a scene at infinity.
  std::optional<Eigen::Matrix3d> homography(double from_s, double to_s) const;
  // The pixel of a direction at infinity.
  std::optional<Eigen::Vector2d> pixel_of(const PanTilt& angles,
                                          const AzimuthElevation& direction) const;
  bool in_picture(const Eigen::Vector2d& pixel) const;

  // The same direction as the counts that the unit reaches on the shortest way, from its position
  // or from `here`; empty: it cannot point there.
  std::optional<PanTilt> reachable(const PanTilt& angles) const;
  std::optional<PanTilt> reachable_from(const PanTilt& here, PanTilt angles) const;
  // The angles that put a direction on the optical axis; empty: the unit cannot point there.
  std::optional<PanTilt> aim(const AzimuthElevation& direction) const;

 private:
  StationGeometry geometry_;
  sensors::StationPose pose_;
  sensors::StationPose revision_pose_;  // the pose of pose_revision()
  std::int64_t pose_revision_ = 0;
  ptu::PtuLimits limits_;
  ptu::AngleHistory history_;
};

}  // namespace ols::station
