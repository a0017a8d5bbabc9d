// A pinhole with OpenCV's distortion.
#include <Eigen/LU>
#include <cmath>

#include "geometry/lens_projection.h"

namespace ols {
namespace {

constexpr int kIterations = 50;

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

std::optional<Eigen::Vector2d> plane(const CameraIntrinsics& c, const Eigen::Vector3d& p_cam) {
  if (!(p_cam.z() > 0.0)) return std::nullopt;
  const Eigen::Vector2d xy = p_cam.hnormalized();
  const Distorted distorted = distort(c, xy);
  if (!in_valid_field(c, xy, distorted.jacobian)) return std::nullopt;
  return distorted.xy;
}

std::optional<Eigen::Vector3d> ray(const CameraIntrinsics& c, const Eigen::Vector2d& target,
                                   double tolerance_px) {
  const Eigen::Matrix2d A = pixel_by_plane(c);
  Eigen::Vector2d xy = target;
  for (int i = 0; i < kIterations; ++i) {
    const Distorted distorted = distort(c, xy);
    const Eigen::Vector2d residual = target - distorted.xy;
    if ((A * residual).norm() < tolerance_px) {
      if (!in_valid_field(c, xy, distorted.jacobian)) return std::nullopt;
      return xy.homogeneous().normalized();
    }
    xy += distorted.jacobian.inverse() * residual;
  }
  return std::nullopt;
}

Eigen::Matrix<double, 2, 3> by_point(const CameraIntrinsics& c, const Eigen::Vector3d& p_cam) {
  const Eigen::Vector2d xy = p_cam.hnormalized();
  Eigen::Matrix<double, 2, 3> plane_by_point;
  plane_by_point << Eigen::Matrix2d::Identity(), -xy;
  plane_by_point /= p_cam.z();
  return pixel_by_plane(c) * distort(c, xy).jacobian * plane_by_point;
}

Eigen::Matrix<double, 2, 4> by_coefficients(const CameraIntrinsics& c,
                                            const Eigen::Vector3d& p_cam) {
  const Eigen::Vector2d xy = p_cam.hnormalized();
  const double u = xy.squaredNorm();
  const Eigen::Matrix2d A = pixel_by_plane(c);
  Eigen::Matrix<double, 2, 4> J;
  J << A * xy * u, A * xy * u * u, A * xy * u * u * u, Eigen::Vector2d::Zero();
  return J;
}

double angle(const CameraIntrinsics& /*c*/, double radius) { return std::atan(radius); }

}  // namespace

const LensProjection& pinhole_projection() {
  static const LensProjection projection{"k1, k2, p1, p2, k3", plane, ray, by_point,
                                         by_coefficients,      angle};
  return projection;
}

}  // namespace ols
