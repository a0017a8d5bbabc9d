#include "central/estimators/least_squares.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "central/estimators/position_covariance.h"
#include "geometry/angles.h"
#include "geometry/chi_square.h"

namespace ols::fusion {
namespace {

using Matrix32 = Eigen::Matrix<double, 3, 2>;
using Matrix23 = Eigen::Matrix<double, 2, 3>;

constexpr double kNever = std::numeric_limits<double>::infinity();

// All rays relative to their centroid: coordinates of millions of metres would cost precision.
struct Problem {
  const std::vector<Ray>& rays;
  std::vector<RayFrame> frames;
  std::vector<Eigen::Vector3d> origins;  // [m] ECEF components from the centroid
  Eigen::Vector3d centroid_ecef = Eigen::Vector3d::Zero();

  explicit Problem(const std::vector<Ray>& all) : rays(all) {
    for (const Ray& ray : rays) {
      frames.push_back(ray_frame(ray.sight));
      centroid_ecef += ray.sight.origin_ecef / static_cast<double>(rays.size());
    }
    for (const Ray& ray : rays) origins.push_back(ray.sight.origin_ecef - centroid_ecef);
  }
  double ahead(std::size_t i, const Eigen::Vector3d& x) const {
    return frames[i].direction.dot(x - origins[i]);
  }
};

// One ray linearised at x.
struct Linear {
  Eigen::Vector2d residual;
  Matrix23 jacobian;
  Eigen::Matrix2d covariance;
  Eigen::Matrix2d information;
};

Linear linearise(const Problem& problem, std::size_t i, const Eigen::Vector3d& x) {
  const Eigen::Vector3d p = x - problem.origins[i];
  const RayFrame& frame = problem.frames[i];
  const double depth = frame.direction.dot(p);
  Linear linear;
  linear.residual = frame.tangent.transpose() * p / depth;
  linear.jacobian =
      (frame.tangent.transpose() - linear.residual * frame.direction.transpose()) / depth;
  const Ray& ray = problem.rays[i];
  linear.covariance = ray.sight.covariance_white + systematic_covariance(ray, p.norm());
  linear.information = linear.covariance.inverse();
  return linear;
}

struct Fit {
  Solution solution = Solution::kTooFewRays;
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double chi2 = kNever;
  int degrees = 0;
  std::vector<double> weights;
};

int count_used(const std::vector<double>& weights) {
  return static_cast<int>(std::ranges::count_if(weights, [](double w) { return w > 0.0; }));
}

// Point of least squared distance to all lines; nullopt when they are parallel.
std::optional<Eigen::Vector3d> linear_start(const Problem& problem,
                                            const std::vector<double>& weights) {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (weights[i] <= 0.0) continue;
    const Eigen::Vector3d& d = problem.frames[i].direction;
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - d * d.transpose();
    A += across;
    b += across * problem.origins[i];
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(A);
  constexpr double kParallel = 1e-12;  // half the squared crossing angle: about a microradian
  if (eigen.eigenvalues()(0) < kParallel * eigen.eigenvalues()(2)) return std::nullopt;
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseInverse().asDiagonal() *
         eigen.eigenvectors().transpose() * b;
}

bool behind_any(const Problem& problem, const std::vector<double>& weights,
                const Eigen::Vector3d& x) {
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (weights[i] > 0.0 && problem.ahead(i, x) <= 0.0) return true;
  }
  return false;
}

// Normal equations at x: information matrix, gradient and chi^2.
struct Normal {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double chi2 = 0.0;
};

Normal normal_at(const Problem& problem, const std::vector<double>& weights,
                 const Eigen::Vector3d& x) {
  Normal normal;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (weights[i] <= 0.0) continue;
    const Linear linear = linearise(problem, i, x);
    const Matrix32 weighted = weights[i] * linear.jacobian.transpose() * linear.information;
    normal.information += weighted * linear.jacobian;
    normal.gradient += weighted * linear.residual;
    normal.chi2 += weights[i] * linear.residual.dot(linear.information * linear.residual);
  }
  return normal;
}

// Why the initial point is behind a camera: nearly parallel rays may put it there by chance.
Solution why_behind(const Problem& problem, const std::vector<double>& weights) {
  std::vector<RayUse> use(weights.size());
  for (std::size_t i = 0; i < weights.size(); ++i) use[i].used = weights[i] > 0.0;
  const double crossing_rad = crossing_angle(problem.rays, use);
  double variance = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (!use[i].used) continue;
    const LineOfSight& sight = problem.rays[i].sight;
    variance = std::max(variance, (sight.covariance_white + sight.covariance_systematic).trace());
  }
  const double doubtful_rad = 3.0 * std::sqrt(2.0 * variance);
  return crossing_rad < doubtful_rad ? Solution::kParallelRays : Solution::kBehindCamera;
}

// Gauss-Newton; a step that would pass a camera is halved.
Solution iterate(const Problem& problem, const LeastSquaresConfig& config, Fit& fit) {
  for (int iteration = 0; iteration < config.max_iterations; ++iteration) {
    const Normal normal = normal_at(problem, fit.weights, fit.x);
    Eigen::Vector3d step = -normal.information.ldlt().solve(normal.gradient);
    if (!step.allFinite()) return Solution::kParallelRays;
    for (int halving = 0; behind_any(problem, fit.weights, fit.x + step); ++halving) {
      if (halving == 20) return Solution::kBehindCamera;
      step /= 2.0;
    }
    fit.x += step;
    if (step.dot(normal.information * step) < 1e-12) return Solution::kOk;
    if (fit.x.norm() > 100.0 * config.max_range_m) return Solution::kTooFar;
  }
  return Solution::kNotConverged;
}

Solution judge(const Problem& problem, const LeastSquaresConfig& config, const Fit& fit) {
  double nearest_m = kNever;
  for (std::size_t i = 0; i < fit.weights.size(); ++i) {
    if (fit.weights[i] > 0.0) {
      nearest_m = std::min(nearest_m, (fit.x - problem.origins[i]).norm());
    }
  }
  const double greatest_variance =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(fit.covariance, Eigen::EigenvaluesOnly)
          .eigenvalues()(2);
  const double limit_m = config.range_sd_limit * nearest_m;
  if (!(greatest_variance < limit_m * limit_m)) return Solution::kParallelRays;
  return nearest_m > config.max_range_m ? Solution::kTooFar : Solution::kOk;
}

Fit fit_weighted(const Problem& problem, std::vector<double> weights,
                 const LeastSquaresConfig& config) {
  Fit fit;
  fit.weights = std::move(weights);
  const int used = count_used(fit.weights);
  fit.degrees = 2 * used - 3;
  if (used < 2) return fit;
  const auto start = linear_start(problem, fit.weights);
  if (!start) {
    fit.solution = Solution::kParallelRays;
    return fit;
  }
  fit.x = *start;
  if (behind_any(problem, fit.weights, fit.x)) {
    fit.solution = why_behind(problem, fit.weights);
    return fit;
  }
  fit.solution = iterate(problem, config, fit);
  if (fit.solution != Solution::kOk) return fit;
  const Normal normal = normal_at(problem, fit.weights, fit.x);
  const auto covariance = covariance_from(normal.information);
  if (!covariance) {
    fit.solution = Solution::kParallelRays;
    return fit;
  }
  fit.covariance = *covariance;
  fit.chi2 = normal.chi2;
  fit.solution = judge(problem, config, fit);
  return fit;
}

// chi^2 divided by its limit: up to 1, the rays are consistent.
double disagreement(const Fit& fit, const LeastSquaresConfig& config) {
  if (fit.solution != Solution::kOk) return kNever;
  return fit.chi2 / chi_square_critical(normal_level(config.gate_sigma), fit.degrees);
}

// Rejects, one after the other, the ray without which the others agree best.
std::optional<Fit> set_aside(const Problem& problem, const LeastSquaresConfig& config) {
  std::vector<double> weights(problem.rays.size(), 1.0);
  const int most = (static_cast<int>(weights.size()) - 1) / 2;
  for (int removed = 0; removed < most; ++removed) {
    Fit best;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      if (weights[i] <= 0.0) continue;
      std::vector<double> without = weights;
      without[i] = 0.0;
      Fit fit = fit_weighted(problem, std::move(without), config);
      if (best.weights.empty() || disagreement(fit, config) < disagreement(best, config)) {
        best = std::move(fit);
      }
    }
    if (disagreement(best, config) <= 1.0) return best;
    weights = best.weights;
  }
  return std::nullopt;
}

// If no subset of the rays is consistent, all are used: weighted by Huber's function, with an
// inflated covariance.
Fit fit_robustly(const Problem& problem, Fit fit, const LeastSquaresConfig& config) {
  constexpr int kRounds = 10;
  for (int round = 0; round < kRounds && fit.solution == Solution::kOk; ++round) {
    std::vector<double> weights(problem.rays.size());
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const Linear linear = linearise(problem, i, fit.x);
      const double size = std::sqrt(linear.residual.dot(linear.information * linear.residual));
      weights[i] = size > config.huber_sigma ? config.huber_sigma / size : 1.0;
    }
    fit = fit_weighted(problem, std::move(weights), config);
  }
  if (fit.solution != Solution::kOk) return fit;
  fit.covariance *= std::max(1.0, fit.chi2 / fit.degrees);
  fit.solution = judge(problem, config, fit);
  return fit;
}

// The part of the covariance that comes from the rays' white noise.
Eigen::Matrix3d white_part(const Problem& problem, const Fit& fit) {
  Eigen::Matrix3d white = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < fit.weights.size(); ++i) {
    if (fit.weights[i] <= 0.0) continue;
    const Linear linear = linearise(problem, i, fit.x);
    const Matrix32 gain =
        fit.weights[i] * fit.covariance * linear.jacobian.transpose() * linear.information;
    white += gain * problem.rays[i].sight.covariance_white * gain.transpose();
  }
  return white;
}

// A used ray pulls the fit towards itself, a rejected one does not: hence the sign.
RayUse use_of(const Problem& problem, const Fit& fit, std::size_t i) {
  RayUse use{.used = fit.weights[i] > 0.0, .weight = fit.weights[i]};
  if (problem.ahead(i, fit.x) <= 0.0) return use;
  const Linear linear = linearise(problem, i, fit.x);
  const Eigen::Matrix2d position = linear.jacobian * fit.covariance * linear.jacobian.transpose();
  const double sign = use.used ? -use.weight : 1.0;
  use.squared = linear.residual.dot(linear.information * linear.residual);
  use.expected = std::max(0.0, 2.0 + sign * (linear.information * position).trace());
  use.residual_rad = linear.residual;
  use.variance_rad2 = linear.covariance.diagonal();
  use.redundancy = (1.0 + sign * position.diagonal().array() / use.variance_rad2.array()).max(0.0);
  return use;
}

}  // namespace

Estimate least_squares(const std::vector<Ray>& rays, const LeastSquaresConfig& config) {
  Estimate estimate;
  estimate.rays.resize(rays.size());
  if (rays.size() < 2) return estimate;
  const Problem problem(rays);
  Fit fit = fit_weighted(problem, std::vector<double>(rays.size(), 1.0), config);
  if (disagreement(fit, config) > 1.0) {
    if (auto rest = set_aside(problem, config)) {
      fit = std::move(*rest);
    } else {
      fit = fit_robustly(problem, std::move(fit), config);
    }
  }
  estimate.solution = fit.solution;
  if (fit.solution != Solution::kOk) return estimate;
  estimate.position_ecef = problem.centroid_ecef + fit.x;
  estimate.covariance_ecef = fit.covariance;
  estimate.covariance_white_ecef = white_part(problem, fit);
  for (std::size_t i = 0; i < rays.size(); ++i) estimate.rays[i] = use_of(problem, fit, i);
  estimate.crossing_angle_rad = crossing_angle(rays, estimate.rays);
  estimate.residual = std::sqrt(fit.chi2 / fit.degrees);
  return checked(std::move(estimate));
}

void estimate_velocity(const std::vector<Ray>& rays, Estimate& estimate) {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!estimate.rays[i].used) continue;
    const RayFrame frame = ray_frame(rays[i].sight);
    const double range_m = (estimate.position_ecef - rays[i].sight.origin_ecef).norm();
    const Matrix32 H = frame.tangent / range_m;  // transpose of d rate / d velocity
    const Matrix32 weighted =
        estimate.rays[i].weight * H * rays[i].rate_covariance.inverse().eval();
    information += weighted * H.transpose();
    right += weighted * rays[i].rate_rad_s;
  }
  const auto covariance = covariance_from(information);
  if (!covariance) return;
  const Eigen::Vector3d velocity = *covariance * right;
  if (!velocity.allFinite()) return;
  estimate.velocity_ecef = velocity;
  estimate.velocity_covariance_ecef = *covariance;
}

}  // namespace ols::fusion
