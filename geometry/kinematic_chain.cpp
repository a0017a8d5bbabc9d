#include "geometry/kinematic_chain.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "geometry/angles.h"

namespace ols {
namespace {

// Rounding that a direction on the edge of what can be reached may have.
constexpr double kAimTolerance = 1e-12;

Eigen::AngleAxisd RZ(double rad) { return {rad, Eigen::Vector3d::UnitZ()}; }
Eigen::AngleAxisd RX(double rad) { return {rad, Eigen::Vector3d::UnitX()}; }
Eigen::AngleAxisd RY(double rad) { return {rad, Eigen::Vector3d::UnitY()}; }

// OpenCV's camera axes (right, down, forward) in the X-forward frame of the chain.
Eigen::Matrix3d R_chain_cam() {
  return Eigen::Matrix3d{{0.0, 0.0, 1.0}, {-1.0, 0.0, 0.0}, {0.0, -1.0, 0.0}};
}

Eigen::Matrix3d link_rotation(const Link& link) {
  return (RZ(link.rz_rad) * RX(link.rx_rad) * RY(link.ry_rad)).toRotationMatrix();
}

PanTilt reported_from_shaft(const ChainParameters& chain, double pan_rad, double tilt_rad) {
  return {wrap_pi(chain.pan_sign * (pan_rad - chain.pan_zero_rad)),
          chain.tilt_sign * (tilt_rad - chain.tilt_zero_rad)};
}

// Shaft tilt t, in -pi/2..pi/2, with which RX(trunnion) RY(-t) lifts m to the height of d (both
// unit). RY(-t) turns m in the plane X-Z and leaves its Y, so the height that it must give m before
// the trunnion error is known; of the two angles at that height the first one leaves m in front of
// the tilt axis.
std::optional<double> tilt_to_height_of(const Eigen::Vector3d& d, const Eigen::Vector3d& m,
                                        double trunnion_rad) {
  const double d_level = d.head<2>().norm();
  const double m_across = std::abs(m.y());
  const double height = (d.z() - std::sin(trunnion_rad) * m.y()) / std::cos(trunnion_rad);
  const double reach =
      (d_level - m_across) * (d_level + m_across) + (d.z() - height) * (d.z() + height);
  const bool on_tilt_axis = std::hypot(m.x(), m.z()) <= kAimTolerance;
  if (!(reach >= -kAimTolerance * (d_level + m_across)) || on_tilt_axis) return std::nullopt;
  const double forward = std::sqrt(std::max(0.0, reach));
  const double own_angle = std::atan2(m.z(), m.x());
  for (const double x : {forward, -forward}) {
    const double tilt = wrap_pi(std::atan2(height, x) - own_angle);
    if (std::abs(tilt) <= kPi / 2.0 + kAimTolerance) return tilt;
  }
  return std::nullopt;
}

}  // namespace

Eigen::Isometry3d next_joint(const Eigen::Isometry3d& M_previous, const Link& link) {
  return M_previous * Eigen::Translation3d(link.translation_m) * RZ(link.rz_rad) * RX(link.rx_rad) *
         RY(link.ry_rad);
}

std::array<Link, kJoints - 1> links(const ChainParameters& chain, const PanTilt& angles) {
  const double shaft_pan_rad = chain.pan_sign * angles.pan_rad + chain.pan_zero_rad;
  const double shaft_tilt_rad = chain.tilt_sign * angles.tilt_rad + chain.tilt_zero_rad;
  return {{
      // Azimuth turns clockwise from north, RZ counter-clockwise from east.
      {chain.ground_to_origin_m, kPi / 2.0 - chain.heading_rad, chain.tilt_x_rad, chain.tilt_y_rad},
      {chain.origin_to_azi_m, shaft_pan_rad, 0.0, 0.0},
      // A positive tilt looks up, a positive RY down.
      {chain.azi_to_ele_m, 0.0, chain.trunnion_rad, -shaft_tilt_rad},
      {chain.ele_to_focus_m, chain.mount_z_rad, chain.mount_x_rad, chain.mount_y_rad},
      {chain.focus_to_camera_m, 0.0, 0.0, 0.0},
  }};
}

std::array<Eigen::Isometry3d, kJoints> joints(const ChainParameters& chain, const PanTilt& angles) {
  std::array<Eigen::Isometry3d, kJoints> poses;
  poses[0] = Eigen::Isometry3d::Identity();
  std::size_t i = 0;
  for (const Link& link : links(chain, angles)) {
    poses[i + 1] = next_joint(poses[i], link);
    ++i;
  }
  return poses;
}

Eigen::Isometry3d enu_from_camera(const ChainParameters& chain, const PanTilt& angles) {
  Eigen::Isometry3d pose = joints(chain, angles).back();
  pose.rotate(R_chain_cam());
  return pose;
}

std::optional<PanTilt> aim(const ChainParameters& chain, const Eigen::Vector3d& direction_enu,
                           const Eigen::Vector3d& direction_cam) {
  if (!(direction_enu.norm() > 0.0 && direction_cam.norm() > 0.0)) return std::nullopt;
  const auto link = links(chain, {});
  // Wanted: RZ(pan) RX(trunnion) RY(-tilt) m = d, d in ORIGIN and m in the frame that tilts.
  const Eigen::Vector3d d = link_rotation(link[0]).transpose() * direction_enu.normalized();
  const Eigen::Vector3d m = link_rotation(link[3]) * R_chain_cam() * direction_cam.normalized();
  const std::optional<double> tilt_rad = tilt_to_height_of(d, m, chain.trunnion_rad);
  if (!tilt_rad) return std::nullopt;
  const Eigen::Vector3d tilted = RX(chain.trunnion_rad) * (RY(-*tilt_rad) * m).eval();
  // Straight up or down every pan is right: zero.
  const bool on_pan_axis = d.head<2>().norm() <= kAimTolerance;
  const double pan_rad =
      on_pan_axis ? 0.0 : std::atan2(d.y(), d.x()) - std::atan2(tilted.y(), tilted.x());
  return reported_from_shaft(chain, pan_rad, *tilt_rad);
}

}  // namespace ols
