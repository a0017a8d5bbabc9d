#include "central/estimators/paper_triangulation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/precision_paper.h"

namespace ols::fusion {
namespace {

constexpr double kSamePlaceM = 1e-3;

// A pair of views whose rays intersect.
struct Base {
  Eigen::Vector3d point;  // t_i
  Baseline baseline;
};

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

// All pairs that intersect; `failure` becomes the last pair's reason.
std::vector<Base> bases_of(const std::vector<PaperView>& views, const PaperConfig& config,
                           Solution& failure) {
  std::vector<Base> bases;
  for (std::size_t i = 0; i < views.size(); ++i) {
    for (std::size_t j = i + 1; j < views.size(); ++j) {
      const PaperPoint point = paper_two_view(views[i], views[j], config);
      if (point.solution != Solution::kOk) {
        failure = point.solution;
        continue;
      }
      bases.push_back({point.position_ecef, {views[i].centre_ecef, views[j].centre_ecef}});
    }
  }
  return bases;
}

Eigen::Vector3d unweighted_centroid(const std::vector<Base>& bases) {
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  for (const Base& base : bases) offset += base.point - bases.front().point;
  return bases.front().point + offset / static_cast<double>(bases.size());
}

std::vector<PaperView> views_of(const std::vector<Ray>& rays) {
  std::vector<PaperView> views;
  for (const Ray& ray : rays) {
    views.push_back({ray.sight.origin_ecef, direction_ecef(ray.sight), ray.belief});
  }
  return views;
}

// d position / d (cross-elevation, elevation) of one view, by central differences.
std::optional<Eigen::Matrix<double, 3, 2>> derivative(std::vector<PaperView> views,
                                                      std::size_t index, const RayFrame& frame,
                                                      const PaperConfig& config) {
  constexpr double kStepRad = 1e-7;
  Eigen::Matrix<double, 3, 2> jacobian;
  for (int axis = 0; axis < 2; ++axis) {
    PaperPoint ends[2];
    for (int side = 0; side < 2; ++side) {
      const double step = side == 0 ? -kStepRad : kStepRad;
      views[index].direction_ecef = (frame.direction + step * frame.tangent.col(axis)).normalized();
      ends[side] = paper_n_view(views, config);
      if (ends[side].solution != Solution::kOk) return std::nullopt;
    }
    jacobian.col(axis) = (ends[1].position_ecef - ends[0].position_ecef) / (2.0 * kStepRad);
  }
  return jacobian;
}

// Sets both covariances; false if the estimator cannot be differentiated.
bool propagate(const std::vector<Ray>& rays, const PaperConfig& config, Estimate& estimate) {
  const std::vector<PaperView> views = views_of(rays);
  estimate.covariance_ecef.setZero();
  estimate.covariance_white_ecef.setZero();
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto J = derivative(views, i, ray_frame(rays[i].sight), config);
    if (!J) return false;
    const double range_m = (estimate.position_ecef - rays[i].sight.origin_ecef).norm();
    const Eigen::Matrix3d white = *J * rays[i].sight.covariance_white * J->transpose();
    estimate.covariance_white_ecef += white;
    estimate.covariance_ecef +=
        white + *J * systematic_covariance(rays[i], range_m) * J->transpose();
  }
  return true;
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
  Solution failure = Solution::kTooFewRays;
  const std::vector<Base> bases = bases_of(views, config, failure);
  if (bases.empty()) return {failure, nan_vector()};
  const Eigen::Vector3d T0 = unweighted_centroid(bases);  // T' of Algorithm 1, line 4
  if (config.pairs == PaperPairs::kCentroid) return {Solution::kOk, T0};
  if (config.pairs == PaperPairs::kBestBaseline) {
    std::vector<Baseline> baselines;
    for (const Base& base : bases) baselines.push_back(base.baseline);
    return {Solution::kOk, bases[best_baseline(baselines, T0)].point};
  }
  double sum = 0.0;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  for (const Base& base : bases) {
    const double weight = std::exp(normal_component(base.baseline, T0));  // line 6
    sum += weight;
    offset += weight * (base.point - T0);
  }
  return {Solution::kOk, T0 + offset / sum};  // line 8
}

Estimate paper_estimate(const std::vector<Ray>& rays, const PaperConfig& config) {
  Estimate estimate;
  estimate.rays.assign(rays.size(), RayUse{.used = true, .weight = 1.0});
  const PaperPoint point = paper_n_view(views_of(rays), config);
  estimate.solution = point.solution;
  if (point.solution != Solution::kOk) return estimate;
  estimate.position_ecef = point.position_ecef;
  estimate.crossing_angle_rad = crossing_angle(rays, estimate.rays);
  if (!propagate(rays, config, estimate)) {
    estimate = Estimate();
    estimate.solution = Solution::kParallelRays;
    estimate.rays.assign(rays.size(), RayUse{.used = true, .weight = 1.0});
  }
  return estimate;
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
  return average;
}

}  // namespace ols::fusion
