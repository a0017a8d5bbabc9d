#include "sim/world/trajectory.h"

#include <algorithm>
#include <stdexcept>

#include "geometry/angles.h"

namespace ols::sim {

using Eigen::Vector3d;

Motion Lissajous::at(double time_s) const {
  const Eigen::Array3d rate = 2.0 * kPi / period_s.array();
  const Eigen::Array3d angle = rate * time_s + phase_rad.array();
  return {centre_enu + (amplitude_m.array() * angle.sin()).matrix(),
          (amplitude_m.array() * rate * angle.cos()).matrix()};
}

Motion Line::at(double time_s) const { return {start_enu + time_s * v_enu, v_enu}; }

namespace {

void check(const std::vector<double>& times_s, std::size_t points) {
  if (points < 2 || times_s.size() != points) {
    throw std::invalid_argument("needs at least two points");
  }
  for (std::size_t i = 1; i < points; ++i) {
    if (!(times_s[i] > times_s[i - 1])) throw std::invalid_argument("times must increase");
  }
}

// Second derivatives of the natural cubic spline: the tridiagonal system by elimination.
std::vector<Vector3d> natural_curvature(const std::vector<double>& t,
                                        const std::vector<Vector3d>& p) {
  const std::size_t n = t.size();
  std::vector<Vector3d> m(n, Vector3d::Zero()), rhs(n, Vector3d::Zero());
  std::vector<double> diagonal(n, 1.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double before = t[i] - t[i - 1], after = t[i + 1] - t[i];
    diagonal[i] = 2.0 * (before + after);
    rhs[i] = 6.0 * ((p[i + 1] - p[i]) / after - (p[i] - p[i - 1]) / before);
    if (i == 1) continue;
    const double factor = before / diagonal[i - 1];
    diagonal[i] -= factor * before;
    rhs[i] -= factor * rhs[i - 1];
  }
  for (std::size_t i = n - 2; i >= 1; --i) {
    m[i] = (rhs[i] - (t[i + 1] - t[i]) * m[i + 1]) / diagonal[i];
  }
  return m;
}

}  // namespace

Spline::Spline(std::vector<double> times_s, std::vector<Vector3d> points_enu)
    : times_s_(std::move(times_s)), points_(std::move(points_enu)) {
  check(times_s_, points_.size());
  curvature_ = natural_curvature(times_s_, points_);
}

Motion Spline::at(double time_s) const {
  if (time_s <= times_s_.front()) return {points_.front(), Vector3d::Zero()};
  if (time_s >= times_s_.back()) return {points_.back(), Vector3d::Zero()};
  const auto next = std::upper_bound(times_s_.begin(), times_s_.end(), time_s);
  const auto i = static_cast<std::size_t>(next - times_s_.begin()) - 1;
  const double h = times_s_[i + 1] - times_s_[i];
  const double b = (time_s - times_s_[i]) / h, a = 1.0 - b;
  const Vector3d& m0 = curvature_[i];
  const Vector3d& m1 = curvature_[i + 1];
  Motion motion;
  motion.p_enu = a * points_[i] + b * points_[i + 1] +
                 (h * h / 6.0) * ((a * a * a - a) * m0 + (b * b * b - b) * m1);
  motion.v_enu = (points_[i + 1] - points_[i]) / h +
                 (h / 6.0) * ((3.0 * b * b - 1.0) * m1 - (3.0 * a * a - 1.0) * m0);
  return motion;
}

std::unique_ptr<Trajectory> through_waypoints(const std::vector<Vector3d>& points_enu,
                                              double speed_m_s) {
  std::vector<double> times_s;
  for (std::size_t i = 0; i < points_enu.size(); ++i) {
    times_s.push_back(
        i == 0 ? 0.0 : times_s.back() + (points_enu[i] - points_enu[i - 1]).norm() / speed_m_s);
  }
  return std::make_unique<Spline>(std::move(times_s), points_enu);
}

}  // namespace ols::sim
