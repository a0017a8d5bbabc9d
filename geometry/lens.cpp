#include "geometry/lens.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "geometry/lens_projection.h"

namespace ols {
namespace {

constexpr double kUnprojectTolerancePx = 1e-9;

const LensProjection& projection_of(const CameraIntrinsics& camera) {
  switch (camera.model) {
    case LensModel::kFisheye:
      return fisheye_projection();
    case LensModel::kPolynomial:
      return polynomial_projection();
    case LensModel::kPinhole:
      break;
  }
  return pinhole_projection();
}

}  // namespace

CameraIntrinsics undistorted(const CameraIntrinsics& intrinsics) {
  CameraIntrinsics result = intrinsics;
  result.k1 = result.k2 = result.p1 = result.p2 = result.k3 = result.k4 = 0.0;
  return result;
}

std::string foreign_coefficients(const CameraIntrinsics& c) {
  const std::string own = projection_of(c).coefficients;
  std::string foreign;
  for (const auto& [name, value] :
       {std::pair{"k1", c.k1}, std::pair{"k2", c.k2}, std::pair{"p1", c.p1}, std::pair{"p2", c.p2},
        std::pair{"k3", c.k3}, std::pair{"k4", c.k4}}) {
    if (value == 0.0 || own.find(name) != std::string::npos) continue;
    foreign += (foreign.empty() ? "" : ", ") + std::string(name);
  }
  return foreign;
}

Eigen::Matrix2d pixel_by_plane(const CameraIntrinsics& c) {
  return Eigen::Matrix2d{{c.fx_px, c.skew}, {0.0, c.fy_px}};
}

Eigen::Matrix3d camera_matrix(const CameraIntrinsics& intrinsics) {
  Eigen::Matrix3d K = Eigen::Matrix3d::Identity();
  K.topLeftCorner<2, 2>() = pixel_by_plane(intrinsics);
  K(0, 2) = intrinsics.cx_px;
  K(1, 2) = intrinsics.cy_px;
  return K;
}

Eigen::Matrix<double, 3, 4> projection_matrix(const Eigen::Matrix3d& K, const Eigen::Matrix3d& R,
                                              const Eigen::Vector3d& C) {
  Eigen::Matrix<double, 3, 4> P;
  P.leftCols<3>() = K * R;
  P.col(3) = -P.leftCols<3>() * C;
  return P;
}

Eigen::Vector3d back_project(const Eigen::Matrix<double, 3, 4>& P, const Eigen::Vector2d& pixel) {
  // The line P+ x + lambda C meets the plane at infinity at (d, 0) with M d = x, M = K R. Solved
  // so, because with an ECEF-sized C the product P P^T of the pseudo-inverse is near singular.
  const Eigen::Matrix3d M = P.leftCols<3>();
  const Eigen::Vector3d d = M.partialPivLu().solve(pixel.homogeneous().eval());
  return std::copysign(1.0, M.determinant()) * d.normalized();
}

std::optional<Eigen::Vector2d> project(const CameraIntrinsics& intrinsics,
                                       const Eigen::Vector3d& p_cam) {
  const std::optional<Eigen::Vector2d> xy = projection_of(intrinsics).plane(intrinsics, p_cam);
  if (!xy) return std::nullopt;
  return pixel_by_plane(intrinsics) * *xy + Eigen::Vector2d(intrinsics.cx_px, intrinsics.cy_px);
}

std::optional<Eigen::Vector3d> unproject(const CameraIntrinsics& intrinsics,
                                         const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d xy = pixel_by_plane(intrinsics).inverse() *
                             (pixel - Eigen::Vector2d(intrinsics.cx_px, intrinsics.cy_px));
  return projection_of(intrinsics).ray(intrinsics, xy, kUnprojectTolerancePx);
}

Eigen::Matrix<double, 2, 3> project_jacobian(const CameraIntrinsics& intrinsics,
                                             const Eigen::Vector3d& p_cam) {
  return projection_of(intrinsics).by_point(intrinsics, p_cam);
}

Eigen::Matrix<double, 2, 4> project_by_coefficients(const CameraIntrinsics& intrinsics,
                                                    const Eigen::Vector3d& p_cam) {
  return projection_of(intrinsics).by_coefficients(intrinsics, p_cam);
}

Eigen::Vector2d field_of_view(const CameraIntrinsics& intrinsics) {
  const LensProjection& projection = projection_of(intrinsics);
  // The image ends half a pixel beyond the centres of its outer pixels.
  const auto whole_angle = [&](double size_px, double centre_px, double focal_px) {
    return projection.angle(intrinsics, (centre_px + 0.5) / focal_px) +
           projection.angle(intrinsics, (size_px - 0.5 - centre_px) / focal_px);
  };
  return {whole_angle(intrinsics.width_px, intrinsics.cx_px, intrinsics.fx_px),
          whole_angle(intrinsics.height_px, intrinsics.cy_px, intrinsics.fy_px)};
}

}  // namespace ols
