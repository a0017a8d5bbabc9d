// The finite pinhole camera (paper section 6) with OpenCV's distortion model.
//
// Camera frame: OpenCV's, x right, y down, z forward. Pixel (0, 0) is the centre of the top-left
// pixel. Distortion: k1, k2, p1, p2, k3 as in OpenCV's calib3d.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace ols {

struct CameraIntrinsics {
  int width_px = 1280;
  int height_px = 960;
  double fx_px = 50e-3 / 3.75e-6;  // focal length over pixel pitch: 50 mm, 3.75 um
  double fy_px = 50e-3 / 3.75e-6;
  double cx_px = 639.5;
  double cy_px = 479.5;
  double skew = 0.0;  // K(0,1) [px]
  double k1 = 0.0, k2 = 0.0, p1 = 0.0, p2 = 0.0, k3 = 0.0;
};

// K of the paper: [fx s cx; 0 fy cy; 0 0 1].
Eigen::Matrix3d camera_matrix(const CameraIntrinsics& intrinsics);

// P = K R [I | -C] (paper section 6), 3x4, without distortion. R takes world to camera components,
// C is the camera centre in world coordinates [m].
Eigen::Matrix<double, 3, 4> projection_matrix(const Eigen::Matrix3d& K, const Eigen::Matrix3d& R,
                                              const Eigen::Vector3d& C);

// Back-projection X(lambda) = P+ x + lambda C (paper section 6): the unit direction of the line in
// the world frame, from the camera centre to the front of the camera.
Eigen::Vector3d back_project(const Eigen::Matrix<double, 3, 4>& P, const Eigen::Vector2d& pixel);

// The image of a point in camera coordinates [m]. nullopt when it is not in front (z <= 0), or so
// far off the axis that the distortion polynomial folds back. (It would image a point far outside
// the field of view in the middle of the image.)
std::optional<Eigen::Vector2d> project(const CameraIntrinsics& intrinsics,
                                       const Eigen::Vector3d& p_cam);

// Unit direction in the camera frame of the ray through a pixel. Newton's method inverts the
// distortion to below 1e-9 px. nullopt when it does not converge (outside the model's valid field).
std::optional<Eigen::Vector3d> unproject(const CameraIntrinsics& intrinsics,
                                         const Eigen::Vector2d& pixel);

// 2x3 Jacobian of project() with respect to the point, at a point in front of the camera.
Eigen::Matrix<double, 2, 3> project_jacobian(const CameraIntrinsics& intrinsics,
                                             const Eigen::Vector3d& p_cam);

// Full angle of view, horizontal and vertical [rad], through the principal point, without
// distortion.
Eigen::Vector2d field_of_view(const CameraIntrinsics& intrinsics);

}  // namespace ols
