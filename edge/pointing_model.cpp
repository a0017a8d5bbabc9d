#include "edge/pointing_model.h"

namespace ols::station {
namespace {

sensors::StationPose configured_pose(const StationGeometry& geometry) {
  sensors::StationPose pose;
  pose.position = geometry.position;
  pose.position_sd_enu_m.setConstant(geometry.sd.position_m);
  pose.position_source = pose.tilt_source = sensors::PoseSource::kSurveyed;
  pose.tilt_x_rad = geometry.chain.tilt_x_rad;
  pose.tilt_y_rad = geometry.chain.tilt_y_rad;
  pose.tilt_sd_rad = geometry.sd.tilt_rad;
  return pose;
}

}  // namespace

PointingModel::PointingModel(const StationConfig& config)
    : geometry_(config.geometry),
      pose_(configured_pose(config.geometry)),
      revision_pose_(pose_),
      limits_(config.limits),
      history_(config.angles) {}

void PointingModel::set_pose(const sensors::StationPose& pose) {
  if (differs(revision_pose_, pose)) {
    revision_pose_ = pose;
    ++pose_revision_;
  }
  pose_ = pose;
  geometry_.position = pose.position;
  geometry_.chain.tilt_x_rad = pose.tilt_x_rad;
  geometry_.chain.tilt_y_rad = pose.tilt_y_rad;
  geometry_.sd.tilt_rad = pose.tilt_sd_rad;
}

std::optional<Eigen::Matrix3d> PointingModel::homography(double from_s, double to_s) const {
  const auto from = history_.at(from_s);
  const auto to = history_.at(to_s);
  if (!from || !to) return std::nullopt;
  return rotation_homography(geometry_, from->angles, to->angles);
}

std::optional<Eigen::Vector2d> PointingModel::pixel_of(const PanTilt& angles,
                                                       const AzimuthElevation& direction) const {
  constexpr double kFar_m = 1e6;
  const Eigen::Vector3d centre = camera_centre_ecef(geometry_, angles);
  const Eigen::Vector3d point =
      centre + kFar_m * (R_ecef_enu(centre) * enu_from_azimuth_elevation(direction));
  const auto seen = view(geometry_, angles, point);
  if (!seen) return std::nullopt;
  return seen->pixel;
}

bool PointingModel::in_picture(const Eigen::Vector2d& pixel) const {
  const CameraIntrinsics& camera = geometry_.camera;
  return pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() <= camera.width_px &&
         pixel.y() <= camera.height_px;
}

std::optional<PanTilt> PointingModel::reachable(const PanTilt& angles) const {
  const auto newest = history_.newest();
  return reachable_from(newest ? newest->angles : angles, angles);
}

std::optional<PanTilt> PointingModel::reachable_from(const PanTilt& here, PanTilt angles) const {
  if (reach(limits_, here, angles) == ptu::Reach::kUnreachable) return std::nullopt;
  return angles;
}

std::optional<PanTilt> PointingModel::aim(const AzimuthElevation& direction) const {
  const auto angles = aim_along(geometry_, direction);
  return angles ? reachable(*angles) : std::nullopt;
}

}  // namespace ols::station
