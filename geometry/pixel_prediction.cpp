#include "geometry/pixel_prediction.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cmath>

namespace ols {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Matrix23d = Eigen::Matrix<double, 2, 3>;

// An axis that a parameter turns the camera about, in GROUND.
struct Turn {
  Vector3d axis = Vector3d::UnitZ();
  Vector3d point = Vector3d::Zero();  // on the axis
};

struct Turns {
  Turn heading, tilt_x, tilt_y, pan, trunnion, tilt, mount_z, mount_x, mount_y;
};

// The axis of a link's RX comes after its RZ, that of its RY after both.
Vector3d x_axis(const Eigen::Matrix3d& R_previous, const Link& link) {
  return R_previous * Eigen::AngleAxisd(link.rz_rad, Vector3d::UnitZ()) * Vector3d::UnitX();
}

Turns turns_of(const ChainParameters& chain, const PanTilt& angles) {
  const auto poses = joints(chain, angles);
  const auto link = links(chain, angles);
  const auto R = [&poses](Joint j) { return poses[static_cast<std::size_t>(j)].linear(); };
  const auto at = [&poses](Joint j) -> Vector3d {
    return poses[static_cast<std::size_t>(j)].translation();
  };
  const Vector3d origin = at(Joint::kOrigin), ele = at(Joint::kEle), focus = at(Joint::kFocus);
  Turns turns;
  turns.heading = {-Vector3d::UnitZ(), origin};
  turns.tilt_x = {x_axis(R(Joint::kGround), link[0]), origin};
  turns.tilt_y = {R(Joint::kOrigin).col(1), origin};
  turns.pan = {R(Joint::kOrigin).col(2), at(Joint::kAzi)};
  turns.trunnion = {x_axis(R(Joint::kAzi), link[2]), ele};
  turns.tilt = {-R(Joint::kEle).col(1), ele};
  turns.mount_z = {R(Joint::kEle).col(2), focus};
  turns.mount_x = {x_axis(R(Joint::kEle), link[3]), focus};
  turns.mount_y = {R(Joint::kFocus).col(1), focus};
  return turns;
}

// How the image of a target moves: by its displacement seen in GROUND, and by a turn of the camera.
class ImageMotion {
 public:
  ImageMotion(const CameraIntrinsics& camera, const Eigen::Isometry3d& enu_cam,
              const HomogeneousPoint& point)
      : point_(point),
        by_enu_(project_jacobian(camera, enu_cam.linear().transpose() *
                                             (point.x - point.w * enu_cam.translation())) *
                enu_cam.linear().transpose()) {}

  const Matrix23d& by_enu() const { return by_enu_; }
  // The camera turned by an axis is the target turned by its opposite.
  Vector2d by(const Turn& turn) const {
    return -by_enu_ * turn.axis.cross(point_.x - point_.w * turn.point);
  }

 private:
  HomogeneousPoint point_;
  Matrix23d by_enu_;
};

using ByParameters = Eigen::Matrix<double, 2, kModelParameters>;

void add_camera(ByParameters& J, const CameraIntrinsics& camera, const Vector3d& p_cam,
                const Vector2d& pixel) {
  const double aspect = camera.fy_px / camera.fx_px;
  const double y_plane = (pixel.y() - camera.cy_px) / camera.fy_px;
  const double x_plane = (pixel.x() - camera.cx_px - camera.skew * y_plane) / camera.fx_px;
  const Eigen::Matrix<double, 2, 4> by_k = project_by_coefficients(camera, p_cam);
  J.col(kFocal) << x_plane, aspect * y_plane;
  J.col(kAspect) << 0.0, camera.fx_px * y_plane;
  J.col(kCx) = Vector2d::UnitX();
  J.col(kCy) = Vector2d::UnitY();
  J.col(kK1) = by_k.col(0);
  J.col(kK2) = by_k.col(1);
  J.col(kK3) = by_k.col(2);
  J.col(kK4) = by_k.col(3);
}

// By the errors of one axis, of the image's motion with its shaft.
void add_axis(ByParameters& J, const Vector2d& by_shaft, const ShaftAngle& shaft,
              const AxisModel& axis, const AxisReading& reading, int sign, bool is_pan) {
  const double t = shaft.nominal_rad, m = axis.worm_teeth;
  J.col(is_pan ? kPanCos1 : kTiltCos1) = by_shaft * std::cos(t);
  J.col(is_pan ? kPanSin1 : kTiltSin1) = by_shaft * std::sin(t);
  J.col(is_pan ? kPanWormCos : kTiltWormCos) = by_shaft * std::cos(m * t);
  J.col(is_pan ? kPanWormSin : kTiltWormSin) = by_shaft * std::sin(m * t);
  J.col(is_pan ? kPanBacklash : kTiltBacklash) = by_shaft * 0.5 * reading.approach;
  const double rate_rad_s =
      sign * 2.0 * EIGEN_PI * reading.counts_per_s / static_cast<double>(axis.counts_per_turn);
  J.col(kExposureOffset) += by_shaft * shaft.by_nominal * rate_rad_s;
  if (!is_pan) return;
  J.col(kPanCos2) = by_shaft * std::cos(2.0 * t);
  J.col(kPanSin2) = by_shaft * std::sin(2.0 * t);
}

void add_turns(ByParameters& J, const ImageMotion& motion, const Turns& turns) {
  J.col(kHeading) = motion.by(turns.heading);
  J.col(kTiltX) = motion.by(turns.tilt_x);
  J.col(kTiltY) = motion.by(turns.tilt_y);
  J.col(kTrunnion) = motion.by(turns.trunnion);
  J.col(kMountZ) = motion.by(turns.mount_z);
  J.col(kMountX) = motion.by(turns.mount_x);
  J.col(kMountY) = motion.by(turns.mount_y);
}

}  // namespace

std::optional<PixelPrediction> predict_pixel(const StationModel& model, const UnitReading& reading,
                                             const HomogeneousPoint& point) {
  const ChainParameters& chain = model.geometry.chain;
  const CameraIntrinsics& camera = model.geometry.camera;
  const PanTilt angles = corrected_angles(model, reading);
  const Eigen::Isometry3d enu_cam = enu_from_camera(chain, angles);
  PixelPrediction result;
  result.ray_enu = point.x - point.w * enu_cam.translation();
  const Vector3d p_cam = enu_cam.linear().transpose() * result.ray_enu;
  const std::optional<Vector2d> pixel = project(camera, p_cam);
  if (!pixel) return std::nullopt;
  result.pixel = *pixel;
  const ImageMotion motion(camera, enu_cam, point);
  const Turns turns = turns_of(chain, angles);
  result.by_x = motion.by_enu();
  result.by_w = -motion.by_enu() * enu_cam.translation();
  result.by_shafts << motion.by(turns.pan), motion.by(turns.tilt);
  ByParameters& J = result.by_parameters = ByParameters::Zero();
  add_camera(J, camera, p_cam, *pixel);
  add_turns(J, motion, turns);
  add_axis(J, result.by_shafts.col(0),
           shaft_angle(model.pan, chain.pan_sign, chain.pan_zero_rad, reading.pan,
                       model.exposure_offset_s),
           model.pan, reading.pan, chain.pan_sign, true);
  add_axis(J, result.by_shafts.col(1),
           shaft_angle(model.tilt, chain.tilt_sign, chain.tilt_zero_rad, reading.tilt,
                       model.exposure_offset_s),
           model.tilt, reading.tilt, chain.tilt_sign, false);
  J.middleCols<3>(kEast) = -point.w * motion.by_enu();
  return result;
}

std::optional<DirectionPrediction> predict_direction(const StationModel& model,
                                                     const UnitReading& reading,
                                                     const Eigen::Vector2d& pixel) {
  const std::optional<Vector3d> ray_cam = unproject(model.geometry.camera, pixel);
  if (!ray_cam) return std::nullopt;
  const PanTilt angles = corrected_angles(model, reading);
  const Vector3d ray = enu_from_camera(model.geometry.chain, angles).linear() * *ray_cam;
  const auto image = predict_pixel(model, reading, {ray, 0.0});
  if (!image) return std::nullopt;
  DirectionPrediction result;
  result.direction = azimuth_elevation_from_enu(ray);
  // The pixel stays: what the parameters move it by, the direction must take back.
  const Eigen::Matrix2d by_tangent = image->by_x * tangent_basis(result.direction);
  result.by_parameters = -by_tangent.inverse() * image->by_parameters;
  return result;
}

}  // namespace ols
