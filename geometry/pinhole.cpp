#include "geometry/pinhole.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

namespace ols {
namespace {

constexpr double kUnprojectTolerancePx = 1e-9;
constexpr int kUnprojectIterations = 50;

// Coordinates on the plane z = 1, distorted, and their derivative by the undistorted ones.
struct Distorted {
  Eigen::Vector2d xy;
  Eigen::Matrix2d jacobian;
};

Distorted distort(const CameraIntrinsics& c, const Eigen::Vector2d& xy) {
  const double x = xy.x();
  const double y = xy.y();
  const double u = xy.squaredNorm();
  const double radial = 1.0 + u * (c.k1 + u * (c.k2 + u * c.k3));
  const double radial_by_u = c.k1 + u * (2.0 * c.k2 + u * 3.0 * c.k3);
  Distorted result;
  result.xy << x * radial + 2.0 * c.p1 * x * y + c.p2 * (u + 2.0 * x * x),
      y * radial + c.p1 * (u + 2.0 * y * y) + 2.0 * c.p2 * x * y;
  const double mixed = 2.0 * x * y * radial_by_u + 2.0 * c.p1 * x + 2.0 * c.p2 * y;
  result.jacobian << radial + 2.0 * x * x * radial_by_u + 2.0 * c.p1 * y + 6.0 * c.p2 * x, mixed,
      mixed, radial + 2.0 * y * y * radial_by_u + 6.0 * c.p1 * y + 2.0 * c.p2 * x;
  return result;
}

// Whether the distorted radius r (1 + k1 u + k2 u^2 + k3 u^3), u = r^2, grows all the way from the
// axis to u: beyond its first maximum the polynomial folds back and images far directions on
// pixels of near ones.
bool radius_grows_until(const CameraIntrinsics& c, double u) {
  const auto growth = [&c](double s) {
    return 1.0 + s * (3.0 * c.k1 + s * (5.0 * c.k2 + s * 7.0 * c.k3));
  };
  if (!(growth(u) > 0.0)) return false;
  // Between its ends the growth is least where its derivative 3 k1 + 10 k2 s + 21 k3 s^2 is zero.
  const double discriminant = 100.0 * c.k2 * c.k2 - 252.0 * c.k1 * c.k3;
  if (discriminant < 0.0) return true;
  const auto dips_at = [&](double s) { return s > 0.0 && s < u && growth(s) <= 0.0; };
  // The roots in the form that stays exact when k3 is zero.
  const double q = -5.0 * c.k2 - std::copysign(0.5 * std::sqrt(discriminant), c.k2);
  if (q == 0.0) return true;
  return !dips_at(3.0 * c.k1 / q) && !(c.k3 != 0.0 && dips_at(q / (21.0 * c.k3)));
}

bool in_valid_field(const CameraIntrinsics& c, const Eigen::Vector2d& xy,
                    const Eigen::Matrix2d& jacobian) {
  return jacobian.determinant() > 0.0 && radius_grows_until(c, xy.squaredNorm());
}

Eigen::Matrix2d pixel_by_plane(const CameraIntrinsics& c) {
  return Eigen::Matrix2d{{c.fx_px, c.skew}, {0.0, c.fy_px}};
}

}  // namespace

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
  if (!(p_cam.z() > 0.0)) return std::nullopt;
  const Eigen::Vector2d xy = p_cam.hnormalized();
  const Distorted distorted = distort(intrinsics, xy);
  if (!in_valid_field(intrinsics, xy, distorted.jacobian)) return std::nullopt;
  return pixel_by_plane(intrinsics) * distorted.xy +
         Eigen::Vector2d(intrinsics.cx_px, intrinsics.cy_px);
}

std::optional<Eigen::Vector3d> unproject(const CameraIntrinsics& intrinsics,
                                         const Eigen::Vector2d& pixel) {
  const Eigen::Matrix2d A = pixel_by_plane(intrinsics);
  const Eigen::Vector2d target =
      A.inverse() * (pixel - Eigen::Vector2d(intrinsics.cx_px, intrinsics.cy_px));
  Eigen::Vector2d xy = target;
  for (int i = 0; i < kUnprojectIterations; ++i) {
    const Distorted distorted = distort(intrinsics, xy);
    const Eigen::Vector2d residual = target - distorted.xy;
    if ((A * residual).norm() < kUnprojectTolerancePx) {
      if (!in_valid_field(intrinsics, xy, distorted.jacobian)) return std::nullopt;
      return xy.homogeneous().normalized();
    }
    xy += distorted.jacobian.inverse() * residual;
  }
  return std::nullopt;
}

Eigen::Matrix<double, 2, 3> project_jacobian(const CameraIntrinsics& intrinsics,
                                             const Eigen::Vector3d& p_cam) {
  const Eigen::Vector2d xy = p_cam.hnormalized();
  Eigen::Matrix<double, 2, 3> plane_by_point;
  plane_by_point << Eigen::Matrix2d::Identity(), -xy;
  plane_by_point /= p_cam.z();
  return pixel_by_plane(intrinsics) * distort(intrinsics, xy).jacobian * plane_by_point;
}

Eigen::Vector2d field_of_view(const CameraIntrinsics& intrinsics) {
  // The image ends half a pixel beyond the centres of its outer pixels.
  const auto whole_angle = [](double size_px, double centre_px, double focal_px) {
    return std::atan((centre_px + 0.5) / focal_px) +
           std::atan((size_px - 0.5 - centre_px) / focal_px);
  };
  return {whole_angle(intrinsics.width_px, intrinsics.cx_px, intrinsics.fx_px),
          whole_angle(intrinsics.height_px, intrinsics.cy_px, intrinsics.fy_px)};
}

}  // namespace ols
