#include "edge/frames/pointing_model.h"

#include <GeographicLib/Constants.hpp>
#include <cmath>

#include "edge/frames/image_turn.h"
#include "geometry/wgs84.h"

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
      angles_(config.angles),
      approach_({config.angles.step_rad, config.angles.step_rad}),
      zoom_(config.zoom) {
  if (config.calibration) unit_.emplace(*config.calibration);
}

void PointingModel::set_limits(const mount::Limits& limits) {
  limits_ = limits;
  if (!(limits.count.pan_rad > 0.0 && limits.count.tilt_rad > 0.0)) return;
  approach_.set_step(limits.count);
  if (unit_) unit_->set_count(limits.count);
}

void PointingModel::add(const mount::AngleSample& sample) {
  if (angles_.add(sample)) approach_.add(sample.time_s, sample.angles);
}

// The turn of a calibrated unit is that of an ideal one: within a turn between two pictures, its
// errors hardly change. While the mount gives no angles, the last known ones serve: the turn then
// says only that the mount moves.
std::optional<mount::SeenTurn> PointingModel::add(const tracker::ImageMotion& motion, double from_s,
                                                  const camera::Frame& frame) {
  const double to_s = frame.mid_exposure_s;
  const auto zoom = zoom_at(from_s);
  const bool same_zoom = zoom && zoom_rests(from_s) == true && zoom_rests(to_s) == true;
  const auto unit = angles_at(from_s);
  if (unit) last_angles_ = unit->angles;
  if (!same_zoom || !last_angles_) return std::nullopt;
  const auto seen = image_turn(geometry_.chain, zoom->camera, *last_angles_, motion);
  if (!seen) return std::nullopt;
  const mount::SeenTurn turn{.from_s = from_s,
                             .to_s = to_s,
                             .row_s = camera::row_time_s(frame, motion.middle_px.y()) - to_s,
                             .stamp_sd_s = frame.stamp_sd_s,
                             .turn = seen->turn,
                             .sd = seen->sd};
  if (unit) angles_.add(turn);
  return turn;
}

void PointingModel::add(const lens::ZoomSample& sample) {
  if (!zoom_) return;
  zoom_->add(sample);
  if (const auto newest = zoom_->newest()) geometry_.camera = newest->camera;
}

// A lens that does not zoom has no deviation of its own: `sd` of the geometry has everything.
std::optional<ZoomPoint> PointingModel::zoom_at(double time_s) const {
  return zoom_ ? zoom_->at(time_s) : ZoomPoint{0.0, geometry_.camera, 0.0, 0.0};
}

void PointingModel::forget_angles() {
  angles_.clear();
  approach_.clear();
}

void PointingModel::use(const StationGeometry& geometry,
                        const std::optional<StationCalibration>& calibration) {
  geometry_ = geometry;
  if (zoom_ && zoom_->newest()) geometry_.camera = zoom_->newest()->camera;
  pose_ = revision_pose_ = configured_pose(geometry);
  ++pose_revision_;
  unit_.reset();
  if (calibration) unit_.emplace(*calibration);
  set_limits(limits_);
}

void PointingModel::doubt_setup(double heading_sd_rad, double tilt_sd_rad) {
  if (!unit_) return;
  unit_->doubt_setup(heading_sd_rad * heading_sd_rad, tilt_sd_rad * tilt_sd_rad);
  const CalibrationSd& calibrated = unit_->calibration().model.geometry.sd;
  geometry_.sd.heading_rad = std::hypot(calibrated.heading_rad, heading_sd_rad);
  geometry_.sd.tilt_rad = std::hypot(calibrated.tilt_rad, tilt_sd_rad);
  ++pose_revision_;
}

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

UnitAngles PointingModel::unit_angles(const mount::AngleAt& at, double time_s) const {
  UnitAngles unit{at.angles,       at.angles, at.rate, at.covariance, at.lasting_covariance,
                  at.interpolated, {},        time_s};
  if (calibrated()) {
    unit.reading = unit_->reading(at.angles, at.rate, approach_.at(time_s));
    unit.angles = unit_->corrected(unit.reading);
  }
  return unit;
}

std::optional<UnitAngles> PointingModel::angles_at(double time_s, double stamp_sd_s) const {
  const auto at = angles_.at(time_s, stamp_sd_s);
  return at ? std::optional(unit_angles(*at, time_s)) : std::nullopt;
}

std::optional<ExposedCounts> PointingModel::counts_at(double time_s) const {
  const auto at = angles_.reported().at(time_s);
  const PanTilt& count = limits_.count;
  if (!at || !at->interpolated || !(count.pan_rad > 0.0 && count.tilt_rad > 0.0)) {
    return std::nullopt;
  }
  return ExposedCounts{.pan = at->angles.pan_rad / count.pan_rad,
                       .tilt = at->angles.tilt_rad / count.tilt_rad,
                       .pan_s = at->rate.pan_rad / count.pan_rad,
                       .tilt_s = at->rate.tilt_rad / count.tilt_rad,
                       .approach = approach_.at(time_s),
                       .count = count};
}

PanTilt PointingModel::angles_now() const {
  const auto newest = newest_angles();
  if (!newest) return {};
  if (!calibrated()) return newest->angles;
  return unit_->corrected(unit_->reading(newest->angles, {}, approach_.at(newest->time_s)));
}

std::optional<LineOfSight> PointingModel::sight(PixelSight pixel, const UnitAngles& unit) const {
  if (!calibrated()) {
    const auto zoom = zoom_at(unit.time_s);
    if (!zoom) return std::nullopt;
    StationGeometry geometry = geometry_;
    geometry.camera = zoom->camera;
    // An error of the focal length shifts a pixel along its distance from the principal point.
    const Eigen::Vector2d off_centre =
        pixel.pixel - Eigen::Vector2d(zoom->camera.cx_px, zoom->camera.cy_px);
    const Eigen::Vector2d shift = off_centre * (zoom->focal_sd_px / zoom->camera.fx_px);
    pixel.angles = unit.angles;
    pixel.covariance_systematic_px2 +=
        shift * shift.transpose() +
        Eigen::Matrix2d::Identity() * (zoom->centre_sd_px * zoom->centre_sd_px);
    return ols::sight(geometry, pixel);
  }
  return ols::sight(unit_->calibration(),
                    {pixel.pixel, pixel.covariance_px2, pixel.aim_sd_px, unit.reading,
                     pixel.angles_covariance_rad2, pixel.angles_systematic_rad2});
}

std::optional<video::CameraView> PointingModel::camera_at(const UnitAngles& unit) const {
  const auto zoom = zoom_at(unit.time_s);
  if (!zoom) return std::nullopt;
  const Eigen::Matrix3d R_enu_camera = enu_from_camera(geometry_.chain, unit.angles).linear();
  return video::CameraView{
      camera_centre_ecef(geometry_, unit.angles),
      (R_ecef_enu(ecef_from_geodetic(geometry_.position)) * R_enu_camera).transpose(),
      zoom->camera};
}

std::optional<PanTilt> PointingModel::centring(const Eigen::Vector2d& pixel, double time_s) const {
  const auto unit = angles_at(time_s);
  if (!unit) return std::nullopt;
  PixelSight there;
  there.pixel = pixel;
  const auto line = sight(there, *unit);
  return line ? aim_from(unit->reported, line->direction) : std::nullopt;
}

std::optional<Eigen::Matrix3d> PointingModel::homography(double from_s, double to_s) const {
  const auto at_from = angles_.reported().at(from_s), at_to = angles_.reported().at(to_s);
  if (!at_from || !at_to) return std::nullopt;
  const PanTilt from = unit_angles(*at_from, from_s).angles, to = unit_angles(*at_to, to_s).angles;
  if (!zoom_) return rotation_homography(geometry_, from, to);
  const auto zoom_from = zoom_at(from_s), zoom_to = zoom_at(to_s);
  if (!zoom_from || !zoom_to) return std::nullopt;
  StationGeometry wide = geometry_;
  wide.camera = zoom_from->camera;
  const Eigen::Matrix3d K_from = camera_matrix(zoom_from->camera);
  return camera_matrix(zoom_to->camera) * K_from.inverse() * rotation_homography(wide, from, to);
}

std::optional<Eigen::Matrix3d> PointingModel::star_motion(double from_s, double to_s) const {
  const auto unit = angles_at(from_s);
  const auto camera = unit ? camera_at(*unit) : std::nullopt;
  const auto turned = homography(from_s, to_s);
  if (!camera || !turned) return std::nullopt;
  const Eigen::AngleAxisd turn(-GeographicLib::Constants::WGS84_omega() * (to_s - from_s),
                               Eigen::Vector3d::UnitZ());
  const Eigen::Matrix3d K = camera_matrix(camera->intrinsics);
  return *turned * K * camera->R_camera_ecef * turn * camera->R_camera_ecef.transpose() *
         K.inverse();
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
  const auto newest = newest_angles();
  return reachable_from(newest ? newest->angles : angles, angles);
}

std::optional<PanTilt> PointingModel::reachable_from(const PanTilt& here, PanTilt angles) const {
  if (reach(limits_, here, angles) == mount::Reach::kUnreachable) return std::nullopt;
  return angles;
}

std::optional<PanTilt> PointingModel::aim(const AzimuthElevation& direction) const {
  const auto newest = newest_angles();
  const auto angles = aim_from(newest ? newest->angles : PanTilt{}, direction);
  return angles ? reachable(*angles) : std::nullopt;
}

std::optional<PanTilt> PointingModel::aim_from(const PanTilt& here,
                                               const AzimuthElevation& direction) const {
  const auto angles = aim_along(geometry_, direction);
  if (!angles || !calibrated()) return angles;
  // The turn that it goes to: the side from which it comes is that of this way.
  return unit_->reported(reachable_from(here, *angles).value_or(*angles), here, approach_.newest());
}

}  // namespace ols::station
