#include "central/estimators/paper_triangulation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "central/estimators/paper_pairing.h"
#include "central/estimators/position_covariance.h"
#include "geometry/wgs84.h"

namespace ols::fusion {
namespace {

constexpr double kSamePlaceM = 1e-3;

// Angle from a to b about the unit axis, -pi..pi.
double angle_about(const Eigen::Vector3d& axis, const Eigen::Vector3d& a,
                   const Eigen::Vector3d& b) {
  return std::atan2(axis.dot(a.cross(b)), a.dot(b));
}

// Intersection of the coplanar rays centre1 + s u and centre2 + t v.
PaperPoint intersect_in_plane(const PaperView& first, const PaperView& second,
                              const Eigen::Vector3d& u, const Eigen::Vector3d& v,
                              const PaperConfig& config) {
  const Eigen::Vector3d baseline = second.centre_ecef - first.centre_ecef;
  const Eigen::Vector3d normal = u.cross(v);
  const double sine = normal.norm();
  if (sine < std::sin(config.min_crossing_rad)) return {Solution::kParallelRays, nan_vector()};
  const double s = baseline.cross(v).dot(normal) / (sine * sine);
  const double t = baseline.cross(u).dot(normal) / (sine * sine);
  if (s <= 0.0 || t <= 0.0) return {Solution::kBehindCamera, nan_vector()};
  if (std::max(s, t) > config.max_range_m) return {Solution::kTooFar, nan_vector()};
  return {Solution::kOk, first.centre_ecef + s * u};
}

// The axes at each ray's origin, computed once: nothing else about a ray costs as much.
std::vector<Eigen::Matrix3d> axes_of(const std::vector<Ray>& rays) {
  std::vector<Eigen::Matrix3d> axes;
  for (const Ray& ray : rays) axes.push_back(R_ecef_enu(ray.sight.origin_ecef));
  return axes;
}

std::vector<PaperView> views_of(const std::vector<Ray>& rays,
                                const std::vector<Eigen::Matrix3d>& axes) {
  std::vector<PaperView> views;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const LineOfSight& sight = rays[i].sight;
    const Eigen::Vector3d direction = axes[i] * enu_from_azimuth_elevation(sight.direction);
    views.push_back({sight.origin_ecef, direction, rays[i].belief});
  }
  return views;
}

double crossing_angle_of(const std::vector<PaperView>& views) {
  std::vector<Eigen::Vector3d> directions;
  for (const PaperView& view : views) directions.push_back(view.direction_ecef);
  return crossing_angle(directions);
}

// Sets both covariances, to first order.
void propagate(const std::vector<Ray>& rays, const std::vector<Eigen::Matrix3d>& axes,
               const std::vector<Eigen::Matrix3d>& derivatives, Estimate& estimate) {
  estimate.covariance_ecef.setZero();
  estimate.covariance_white_ecef.setZero();
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Eigen::Matrix<double, 3, 2> J =
        derivatives[i] * ray_frame(rays[i].sight, axes[i]).tangent;
    const double range_m = (estimate.position_ecef - rays[i].sight.origin_ecef).norm();
    const Eigen::Matrix3d white = J * rays[i].sight.covariance_white * J.transpose();
    estimate.covariance_white_ecef += white;
    estimate.covariance_ecef += white + J * systematic_covariance(rays[i], range_m) * J.transpose();
  }
}

}  // namespace

PaperPoint paper_two_view(const PaperView& first, const PaperView& second,
                          const PaperConfig& config) {
  const Eigen::Vector3d baseline = second.centre_ecef - first.centre_ecef;
  if (baseline.norm() < kSamePlaceM) return {Solution::kParallelRays, nan_vector()};
  const Eigen::Vector3d m = baseline.normalized();
  const Eigen::Vector3d normal_u = m.cross(first.direction_ecef);
  const Eigen::Vector3d normal_v = m.cross(second.direction_ecef);
  // A ray along the baseline spans no plane with it.
  if (normal_u.norm() < config.min_crossing_rad || normal_v.norm() < config.min_crossing_rad) {
    return {Solution::kParallelRays, nan_vector()};
  }
  const double alpha = angle_about(m, normal_u, normal_v);
  const double belief = config.by_belief ? first.belief + second.belief : 0.0;
  const double beta1 = belief > 0.0 ? alpha * second.belief / belief : alpha / 2.0;
  const double beta2 = alpha - beta1;
  const Eigen::Vector3d u = Eigen::AngleAxisd(beta1, m) * first.direction_ecef;
  const Eigen::Vector3d v = Eigen::AngleAxisd(-beta2, m) * second.direction_ecef;
  return intersect_in_plane(first, second, u, v, config);
}

PaperPoint paper_n_view(const std::vector<PaperView>& views, const PaperConfig& config) {
  const PaperPairing pairing = pair_views(views, config);
  return {pairing.solution, pairing.position_ecef};
}

Estimate paper_estimate(const std::vector<Ray>& rays, const PaperConfig& config) {
  Estimate estimate;
  estimate.rays.assign(rays.size(), RayUse{.used = true, .weight = 1.0});
  const std::vector<Eigen::Matrix3d> axes = axes_of(rays);
  const std::vector<PaperView> views = views_of(rays, axes);
  const PaperPairing pairing = pair_views(views, config);
  estimate.solution = pairing.solution;
  if (pairing.solution != Solution::kOk) return estimate;
  estimate.position_ecef = pairing.position_ecef;
  estimate.crossing_angle_rad = crossing_angle_of(views);
  propagate(rays, axes, derivatives_by_direction(views, pairing, config), estimate);
  return checked(std::move(estimate));
}

// The covariance between the noise of two estimates, by the overlap of their windows.
double MovingAverage::shared(std::int64_t first_us, std::int64_t second_us) const {
  const double apart_s = 1e-6 * std::abs(static_cast<double>(second_us - first_us));
  return apart_s < window_s_ ? 1.0 - apart_s / window_s_ : 0.0;
}

Estimate MovingAverage::add(const Estimate& estimate, std::int64_t utime_us) {
  estimates_.push_back({utime_us, estimate});
  if (static_cast<int>(estimates_.size()) > h_) estimates_.pop_front();
  const double n = static_cast<double>(estimates_.size());
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  Eigen::Matrix3d white = Eigen::Matrix3d::Zero();
  for (const Timed& each : estimates_) {
    offset += (each.estimate.position_ecef - estimate.position_ecef) / n;
    double counts = 0.0;  // its own noise and the share of the others that overlaps
    for (const Timed& other : estimates_) {
      counts += &each == &other ? 1.0 : shared(each.utime_us, other.utime_us);
    }
    white += counts * each.estimate.covariance_white_ecef / (n * n);
  }
  Estimate average = estimate;
  average.position_ecef += offset;
  average.covariance_ecef += white - estimate.covariance_white_ecef + offset * offset.transpose();
  average.covariance_white_ecef = white;
  return checked(std::move(average));
}

}  // namespace ols::fusion
