// The model of a lens: computes the pixel of a point, and the direction of a pixel.
//
// The camera frame is that of OpenCV: x right, y down, z forward. Pixel (0, 0) is the centre of the
// top-left pixel. A lens model maps a direction to a point on a plane, and the camera matrix K maps
// that point to a pixel. With theta the angle off the optical axis:
//
//   pinhole      (x/z, y/z), distorted by k1, k2, p1, p2, k3 as in OpenCV's calib3d
//   fisheye      radius theta (1 + k1 theta^2 + k2 theta^4 + k3 theta^6 + k4 theta^8): OpenCV's
//   polynomial   radius theta (1 + k1 theta + k2 theta^2 + k3 theta^3 + k4 theta^4)
//
// Each model ends at the angle where its radius stops increasing: beyond this angle, directions
// would get the same pixels as directions nearer to the axis. The fisheye and polynomial models
// extend behind the camera, up to theta = 180 degrees.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>

namespace ols {

enum class LensModel { kPinhole, kFisheye, kPolynomial };
// The names in files, in the order of LensModel.
inline constexpr std::array<const char*, 3> kLensModelNames{"pinhole", "fisheye", "polynomial"};

struct CameraIntrinsics {
  int width_px = 1280;
  int height_px = 960;
  double fx_px = 50e-3 / 3.75e-6;  // focal length over pixel pitch: 50 mm, 3.75 um
  double fy_px = 50e-3 / 3.75e-6;
  double cx_px = 639.5;
  double cy_px = 479.5;
  double skew = 0.0;  // K(0,1) [px]
  LensModel model = LensModel::kPinhole;
  double k1 = 0.0, k2 = 0.0, p1 = 0.0, p2 = 0.0, k3 = 0.0, k4 = 0.0;
};
// The same camera without distortion.
CameraIntrinsics undistorted(const CameraIntrinsics& intrinsics);
// The names of coefficients that are not zero although the lens model does not use them, for
// example "p1, p2". Empty if there are none.
std::string foreign_coefficients(const CameraIntrinsics& intrinsics);

// K of the paper: [fx s cx; 0 fy cy; 0 0 1].
Eigen::Matrix3d camera_matrix(const CameraIntrinsics& intrinsics);

// P = K R [I | -C] (paper section 6), 3x4, for a pinhole without distortion. R takes world
// components to camera components. C is the camera centre in world coordinates [m].
Eigen::Matrix<double, 3, 4> projection_matrix(const Eigen::Matrix3d& K, const Eigen::Matrix3d& R,
                                              const Eigen::Vector3d& C);

// Back-projection X(lambda) = P+ x + lambda C (paper section 6): returns the unit direction of the
// line in the world frame, pointing from the camera centre to the front.
Eigen::Vector3d back_project(const Eigen::Matrix<double, 3, 4>& P, const Eigen::Vector2d& pixel);

// The pixel of a point in camera coordinates [m]. nullopt if the model has no image of the point:
// it is behind a pinhole (z <= 0), or beyond the angle where the model ends.
std::optional<Eigen::Vector2d> project(const CameraIntrinsics& intrinsics,
                                       const Eigen::Vector3d& p_cam);

// The unit vector, in the camera frame, of the ray through a pixel. Computed by Newton's method,
// with an error below 1e-9 px. nullopt if the pixel is outside the model's image.
std::optional<Eigen::Vector3d> unproject(const CameraIntrinsics& intrinsics,
                                         const Eigen::Vector2d& pixel);

// 2x3 Jacobian of project() with respect to the point, for a point that has an image.
Eigen::Matrix<double, 2, 3> project_jacobian(const CameraIntrinsics& intrinsics,
                                             const Eigen::Vector3d& p_cam);

// 2x4 Jacobian of project() with respect to k1, k2, k3, k4.
Eigen::Matrix<double, 2, 4> project_by_coefficients(const CameraIntrinsics& intrinsics,
                                                    const Eigen::Vector3d& p_cam);

// Full angle of view through the principal point, horizontal and vertical [rad]; at most 2 pi. The
// distortion of a pinhole is ignored.
Eigen::Vector2d field_of_view(const CameraIntrinsics& intrinsics);

}  // namespace ols
