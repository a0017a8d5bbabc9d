// The camera station as a kinematic chain (paper section 3, eq. (1), Figure 2): six joints GROUND,
// ORIGIN, AZI, ELE, FOCUS, CAMERA and the five links between them,
//
//   M_next = M_previous T_next RZ_next RX_next RY_next                                   (1)
//
// Frames are right-handed with X forward, Y left, Z up. GROUND is the local east-north-up frame of
// the station (X east, Y north, Z up). The origin of CAMERA is the centre of projection. A further,
// fixed rotation leads from CAMERA, whose X axis points forward, to OpenCV's camera frame (x right,
// y down, z forward). Angles are right-handed about the named axis. A positive rotation about Z
// turns the camera to the left, about Y it turns the camera down, and about X it rolls the camera
// clockwise as seen from behind.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>

namespace ols {

enum class Joint { kGround, kOrigin, kAzi, kEle, kFocus, kCamera };
inline constexpr int kJoints = 6;

// One link of eq. (1): from the previous joint to the next one.
struct Link {
  Eigen::Vector3d translation_m = Eigen::Vector3d::Zero();
  double rz_rad = 0.0;
  double rx_rad = 0.0;
  double ry_rad = 0.0;
};

// The parameters of a station's chain; calibration determines them. The heading is the azimuth of
// the direction in which the pan angle is zero.
struct ChainParameters {
  double heading_rad = 0.0;  // clockwise from true north to the X axis of ORIGIN
  double tilt_x_rad = 0.0;   // inclination of ORIGIN about its X axis (roll, right side down > 0)
  double tilt_y_rad = 0.0;   // inclination of ORIGIN about its Y axis (nose down > 0)
  Eigen::Vector3d ground_to_origin_m{0.0, 0.0, 1.5};  // east, north, up
  // From the PTU's base to the intersection of its axes.
  Eigen::Vector3d origin_to_azi_m{0.0, 0.0, 0.09};
  // In the paper, AZI and ELE are at the same position.
  Eigen::Vector3d azi_to_ele_m{0.0, 0.0, 0.0};
  Eigen::Vector3d ele_to_focus_m{0.0, 0.0, 0.06};     // in the tilting frame
  Eigen::Vector3d focus_to_camera_m{0.05, 0.0, 0.0};  // in the paper, the camera is further along X
  // Deviation of the tilt axis from perpendicular to the pan axis, about X of AZI. A positive value
  // raises the left end of the tilt axis.
  double trunnion_rad = 0.0;
  // Rotation of the camera relative to the unit's head (paper section 4.2), at FOCUS.
  double mount_z_rad = 0.0;
  double mount_x_rad = 0.0;
  double mount_y_rad = 0.0;
  // Encoders: shaft angle = sign * reported angle + zero. A positive pan angle of the shaft turns
  // the camera left (about +Z); a positive tilt angle of the shaft turns the camera up.
  int pan_sign = 1;
  int tilt_sign = 1;
  double pan_zero_rad = 0.0;
  double tilt_zero_rad = 0.0;
};

// Pan and tilt as the PTU reports them [rad].
struct PanTilt {
  double pan_rad = 0.0;
  double tilt_rad = 0.0;
};

// One step of eq. (1).
Eigen::Isometry3d next_joint(const Eigen::Isometry3d& M_previous, const Link& link);

// The five links at these PTU angles, in the order ORIGIN..CAMERA.
std::array<Link, kJoints - 1> links(const ChainParameters& chain, const PanTilt& angles);

// Pose of every joint in GROUND, indexed by Joint.
std::array<Eigen::Isometry3d, kJoints> joints(const ChainParameters& chain, const PanTilt& angles);

// Pose of the camera in GROUND. The rotation takes components in OpenCV's camera frame to
// east-north-up components; the translation is the camera centre [m].
Eigen::Isometry3d enu_from_camera(const ChainParameters& chain, const PanTilt& angles);

// The PTU angles that turn `direction_cam` onto `direction_enu`. direction_cam: a unit vector in
// the camera frame (OpenCV axes; z is the optical axis). direction_enu: a unit vector in GROUND. Of
// the two solutions, returns the one with the camera upright: shaft tilt in -pi/2..pi/2, pan in
// -pi..pi. nullopt if there is no solution (near the pan axis).
std::optional<PanTilt> aim(const ChainParameters& chain, const Eigen::Vector3d& direction_enu,
                           const Eigen::Vector3d& direction_cam = Eigen::Vector3d::UnitZ());

}  // namespace ols
