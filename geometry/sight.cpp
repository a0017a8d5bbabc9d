#include "geometry/sight.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <utility>

namespace ols {
namespace {

using Matrix32d = Eigen::Matrix<double, 3, 2>;

// The lever arms are decimetres and the targets far: three or four do; more is out of reach.
constexpr int kAimIterations = 50;
constexpr double kAimConvergedRad = 1e-12;

Eigen::Vector3d axis_of(const Eigen::Isometry3d& pose, int axis) { return pose.linear().col(axis); }

const Eigen::Isometry3d& at(const std::array<Eigen::Isometry3d, kJoints>& poses, Joint joint) {
  return poses[static_cast<std::size_t>(joint)];
}

// Everything in GROUND: a direction's tangent plane (the horizon's at the camera centre) and the
// poses of the joints.
struct Ray {
  Matrix32d tangent;
  std::array<Eigen::Isometry3d, kJoints> poses;
  Eigen::Matrix3d R_enu_cam;
};

// 2x2: tangent plane by (pan, tilt) as reported.
Eigen::Matrix2d tangent_by_angles(const ChainParameters& chain, const Ray& ray) {
  const Eigen::Matrix<double, 2, 3> shift = shift_by_rotation(ray.tangent);
  Eigen::Matrix2d jacobian;
  jacobian.col(0) = chain.pan_sign * shift * axis_of(at(ray.poses, Joint::kAzi), 2);
  jacobian.col(1) = -chain.tilt_sign * shift * axis_of(at(ray.poses, Joint::kEle), 1);
  return jacobian;
}

// The calibration's rotations: heading about the vertical, tilts about the axes that eq. (1) turns
// ORIGIN about (X before the turn about Y), the mounting about the camera's. What they move the
// camera centre by is left out: an arm of 0.2 m times a milliradian is small beside any position_m.
Eigen::Matrix2d calibration_covariance(const StationGeometry& station, const Ray& ray) {
  const CalibrationSd& sd = station.sd;
  const double heading_rad = station.chain.heading_rad;
  const std::array<std::pair<double, Eigen::Vector3d>, 6> rotations{{
      {sd.heading_rad, Eigen::Vector3d::UnitZ()},
      {sd.tilt_rad, {std::sin(heading_rad), std::cos(heading_rad), 0.0}},
      {sd.tilt_rad, axis_of(at(ray.poses, Joint::kOrigin), 1)},
      {sd.mount_rad, ray.R_enu_cam.col(0)},
      {sd.mount_rad, ray.R_enu_cam.col(1)},
      {sd.mount_roll_rad, ray.R_enu_cam.col(2)},
  }};
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  for (const auto& [sd_rad, axis] : rotations) {
    const Eigen::Vector2d shift = sd_rad * shift_by_rotation(ray.tangent) * axis;
    covariance += shift * shift.transpose();
  }
  return covariance;
}

Eigen::Matrix2d transformed(const Eigen::Matrix2d& jacobian, const Eigen::Matrix2d& covariance) {
  return jacobian * covariance * jacobian.transpose();
}

// R that takes components of the horizon at a point (east-north-up of GROUND, metres) to GROUND.
Eigen::Matrix3d R_ground_horizon(const LocalFrame& ground, const Eigen::Vector3d& p_enu) {
  return ground.R_ecef_enu().transpose() * R_ecef_enu(ground.to_ecef(p_enu));
}

// The PTU angles for a direction in GROUND that depends, a little, on where the camera centre is
// and so on the angles themselves.
template <typename DirectionFrom>
std::optional<PanTilt> aim_from_centre(const ChainParameters& chain,
                                       const Eigen::Vector3d& direction_cam,
                                       const DirectionFrom& direction_from) {
  Eigen::Vector3d direction = direction_from(at(joints(chain, {}), Joint::kEle).translation());
  for (int i = 0; i < kAimIterations; ++i) {
    const std::optional<PanTilt> angles = aim(chain, direction, direction_cam);
    if (!angles) return std::nullopt;
    const Eigen::Vector3d better = direction_from(enu_from_camera(chain, *angles).translation());
    if (angle_between(direction, better) < kAimConvergedRad) return angles;
    direction = better;
  }
  return std::nullopt;
}

}  // namespace

std::optional<LineOfSight> sight(const StationGeometry& station, const PixelSight& measurement) {
  const std::optional<Eigen::Vector3d> ray_cam = unproject(station.camera, measurement.pixel);
  if (!ray_cam) return std::nullopt;
  const LocalFrame ground(station.position);
  const Eigen::Isometry3d camera = enu_from_camera(station.chain, measurement.angles);
  const Eigen::Matrix3d R_horizon = R_ground_horizon(ground, camera.translation());
  const Eigen::Vector3d direction = camera.linear() * *ray_cam;

  LineOfSight line;
  line.origin_ecef = ground.to_ecef(camera.translation());
  line.direction = azimuth_elevation_from_enu(R_horizon.transpose() * direction);
  line.origin_sd_enu_m.setConstant(station.sd.position_m);

  const Ray ray{R_horizon * tangent_basis(line.direction),
                joints(station.chain, measurement.angles), camera.linear()};
  const Eigen::Matrix2d tangent_by_pixel =
      (project_jacobian(station.camera, *ray_cam) * camera.linear().transpose() * ray.tangent)
          .inverse();
  const Eigen::Matrix2d by_angles = tangent_by_angles(station.chain, ray);
  line.covariance_white = transformed(tangent_by_pixel, measurement.covariance_px2) +
                          transformed(by_angles, measurement.angles_covariance_rad2);
  line.aim_sd_rad = measurement.aim_sd_px * tangent_by_pixel.norm() / std::sqrt(2.0);
  line.covariance_systematic =
      transformed(tangent_by_pixel, measurement.covariance_systematic_px2) +
      transformed(by_angles, measurement.angles_systematic_rad2) +
      line.aim_sd_rad * line.aim_sd_rad * Eigen::Matrix2d::Identity() +
      calibration_covariance(station, ray);
  return line;
}

std::optional<View> view(const StationGeometry& station, const PanTilt& angles,
                         const Eigen::Vector3d& p_ecef) {
  const Eigen::Vector3d p_enu = LocalFrame(station.position).to_enu(p_ecef);
  const Eigen::Vector3d p_cam =
      enu_from_camera(station.chain, angles).inverse(Eigen::Isometry) * p_enu;
  const std::optional<Eigen::Vector2d> pixel = project(station.camera, p_cam);
  if (!pixel) return std::nullopt;
  return View{*pixel, p_cam.norm()};
}

std::optional<PanTilt> aim_at(const StationGeometry& station, const Eigen::Vector3d& p_ecef,
                              const std::optional<Eigen::Vector2d>& pixel) {
  const std::optional<Eigen::Vector3d> direction_cam =
      pixel ? unproject(station.camera, *pixel) : Eigen::Vector3d::UnitZ();
  if (!direction_cam) return std::nullopt;
  const Eigen::Vector3d p_enu = LocalFrame(station.position).to_enu(p_ecef);
  const auto direction_from = [&](const Eigen::Vector3d& centre_enu) -> Eigen::Vector3d {
    return p_enu - centre_enu;
  };
  return aim_from_centre(station.chain, *direction_cam, direction_from);
}

std::optional<PanTilt> aim_along(const StationGeometry& station,
                                 const AzimuthElevation& direction) {
  const LocalFrame ground(station.position);
  const Eigen::Vector3d direction_horizon = enu_from_azimuth_elevation(direction);
  const auto direction_from = [&](const Eigen::Vector3d& centre_enu) -> Eigen::Vector3d {
    return R_ground_horizon(ground, centre_enu) * direction_horizon;
  };
  return aim_from_centre(station.chain, Eigen::Vector3d::UnitZ(), direction_from);
}

AzimuthElevation optical_axis(const StationGeometry& station, const PanTilt& angles) {
  const LocalFrame ground(station.position);
  const Eigen::Isometry3d camera = enu_from_camera(station.chain, angles);
  const Eigen::Matrix3d R_horizon = R_ground_horizon(ground, camera.translation());
  return azimuth_elevation_from_enu(R_horizon.transpose() * camera.linear().col(2));
}

Eigen::Vector3d camera_centre_ecef(const StationGeometry& station, const PanTilt& angles) {
  return LocalFrame(station.position).to_ecef(enu_from_camera(station.chain, angles).translation());
}

Eigen::Matrix3d rotation_homography(const StationGeometry& station, const PanTilt& from,
                                    const PanTilt& to) {
  const Eigen::Matrix3d K = camera_matrix(station.camera);
  const Eigen::Matrix3d R_enu_from = enu_from_camera(station.chain, from).linear();
  const Eigen::Matrix3d R_enu_to = enu_from_camera(station.chain, to).linear();
  return K * R_enu_to.transpose() * R_enu_from * K.inverse();
}

}  // namespace ols
