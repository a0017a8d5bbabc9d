// Lenses whose radius on the image plane is a polynomial of the angle off the axis.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "geometry/angles.h"
#include "geometry/lens_projection.h"

namespace ols {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Coefficients = std::array<double, 5>;  // of 1, s, ... s^4

constexpr int kIterations = 100;

// radius(theta) = theta p(s), s = theta^kPower, p = 1 + k1 s + ... + k4 s^4.
template <int kPower>
double s_of(double theta) {
  return kPower == 1 ? theta : theta * theta;
}

Coefficients coefficients(const CameraIntrinsics& c) { return {1.0, c.k1, c.k2, c.k3, c.k4}; }

// d radius / d theta as a polynomial of s.
template <int kPower>
Coefficients growth(const CameraIntrinsics& c) {
  Coefficients result = coefficients(c);
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] *= 1.0 + kPower * static_cast<double>(i);
  return result;
}

double value(const Coefficients& p, double s) {
  return p[0] + s * (p[1] + s * (p[2] + s * (p[3] + s * p[4])));
}

// Whether a polynomial in Bernstein's form is positive on the whole of its interval. It lies within
// the hull of its coefficients; where they do not decide, both halves are asked. A root that
// touches zero without crossing it ends at the depth.
bool positive(const Coefficients& b, int depth) {
  if (!(b.front() > 0.0 && b.back() > 0.0)) return false;
  if (std::ranges::all_of(b, [](double x) { return x > 0.0; })) return true;
  if (depth == 0) return false;
  Coefficients left, right = b;  // de Casteljau's halves
  for (std::size_t i = 0; i < b.size(); ++i) {
    left[i] = right[0];
    for (std::size_t j = 0; j + 1 < b.size() - i; ++j) right[j] = 0.5 * (right[j] + right[j + 1]);
  }
  return positive(left, depth - 1) && positive(right, depth - 1);
}

// Whether the radius grows all the way from the axis to theta.
template <int kPower>
bool grows_until(const CameraIntrinsics& c, double theta) {
  constexpr int kDepth = 30;
  constexpr double kBinomial[5] = {1.0, 4.0, 6.0, 4.0, 1.0};
  Coefficients a = growth<kPower>(c);
  double power = 1.0;
  for (std::size_t i = 0; i < a.size(); ++i, power *= s_of<kPower>(theta)) {
    a[i] *= power / kBinomial[i];
  }
  // Sums of sums: sum_i binomial(j, i) a_i for each j.
  for (std::size_t pass = 1; pass < a.size(); ++pass) {
    for (std::size_t j = a.size() - 1; j >= pass; --j) a[j] += a[j - 1];
  }
  return positive(a, kDepth);
}

// Where the radius stops growing, at most 180 degrees.
template <int kPower>
double greatest_angle(const CameraIntrinsics& c) {
  if (grows_until<kPower>(c, kPi)) return kPi;
  double inside = 0.0, outside = kPi;
  for (double middle = 0.5 * kPi; middle > inside && middle < outside;
       middle = 0.5 * (inside + outside)) {
    (grows_until<kPower>(c, middle) ? inside : outside) = middle;
  }
  return inside;
}

template <int kPower>
double radius(const CameraIntrinsics& c, double theta) {
  return theta * value(coefficients(c), s_of<kPower>(theta));
}

// The inverse: Newton's method, which bisects whenever it would leave the bracket. nullopt beyond
// the greatest radius.
template <int kPower>
std::optional<double> theta_of(const CameraIntrinsics& c, double r, double tolerance) {
  double low = 0.0, high = greatest_angle<kPower>(c);
  if (!(r >= 0.0 && r <= radius<kPower>(c, high))) return std::nullopt;
  const Coefficients by_theta = growth<kPower>(c);
  double theta = std::min(r, high);
  for (int i = 0; i < kIterations; ++i) {
    const double off = radius<kPower>(c, theta) - r;
    if (std::abs(off) < tolerance) return theta;
    (off > 0.0 ? high : low) = theta;
    theta -= off / value(by_theta, s_of<kPower>(theta));
    if (!(theta > low && theta < high)) theta = 0.5 * (low + high);
  }
  return std::nullopt;
}

// A point in polar form: its distance from the optical axis, its angle off it, and the way there.
struct Polar {
  explicit Polar(const Vector3d& p)
      : off_axis(p.head<2>().norm()), theta(std::atan2(off_axis, p.z())) {
    if (off_axis > 0.0) outwards = p.head<2>() / off_axis;
  }
  double off_axis, theta;
  Vector2d outwards = Vector2d::UnitX();
};

template <int kPower>
std::optional<Vector2d> plane(const CameraIntrinsics& c, const Vector3d& p_cam) {
  const Polar p(p_cam);
  // Straight behind, no way outwards is the right one.
  if (!(p.theta < kPi && grows_until<kPower>(c, p.theta))) return std::nullopt;
  return radius<kPower>(c, p.theta) * p.outwards;
}

template <int kPower>
std::optional<Vector3d> ray(const CameraIntrinsics& c, const Vector2d& xy, double tolerance_px) {
  const double r = xy.norm();
  const auto theta = theta_of<kPower>(c, r, tolerance_px / pixel_by_plane(c).norm());
  if (!theta) return std::nullopt;
  if (r == 0.0) return Vector3d::UnitZ();
  Vector3d direction;
  direction << std::sin(*theta) / r * xy, std::cos(*theta);
  return direction;
}

template <int kPower>
Eigen::Matrix<double, 2, 3> by_point(const CameraIntrinsics& c, const Vector3d& p_cam) {
  const Polar p(p_cam);
  const double outward = value(growth<kPower>(c), s_of<kPower>(p.theta));  // by theta
  const double around =
      p.off_axis > 0.0 ? radius<kPower>(c, p.theta) / p.off_axis : 1.0 / p_cam.z();
  const double d2 = p_cam.squaredNorm();
  const Eigen::Matrix2d along = p.outwards * p.outwards.transpose();
  Eigen::Matrix<double, 2, 3> J;
  J << outward * p_cam.z() / d2 * along + around * (Eigen::Matrix2d::Identity() - along),
      -outward * p.off_axis / d2 * p.outwards;
  return pixel_by_plane(c) * J;
}

template <int kPower>
Eigen::Matrix<double, 2, 4> by_coefficients(const CameraIntrinsics& c, const Vector3d& p_cam) {
  const Polar p(p_cam);
  const double s = s_of<kPower>(p.theta);
  const Eigen::RowVector4d by_k = p.theta * Eigen::RowVector4d(s, s * s, s * s * s, s * s * s * s);
  return pixel_by_plane(c) * p.outwards * by_k;
}

template <int kPower>
double angle(const CameraIntrinsics& c, double r) {
  constexpr double kTolerance = 1e-12;
  const double theta =
      theta_of<kPower>(c, std::abs(r), kTolerance).value_or(greatest_angle<kPower>(c));
  return std::copysign(theta, r);
}

template <int kPower>
const LensProjection& projection() {
  static const LensProjection projection{"k1, k2, k3, k4", plane<kPower>,           ray<kPower>,
                                         by_point<kPower>, by_coefficients<kPower>, angle<kPower>};
  return projection;
}

}  // namespace

const LensProjection& fisheye_projection() { return projection<2>(); }
const LensProjection& polynomial_projection() { return projection<1>(); }

}  // namespace ols
