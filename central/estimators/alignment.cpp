#include "central/estimators/alignment.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "central/measurement/place_axes.h"

namespace ols::fusion {
namespace {

// One bearing on the tangent plane of the reference direction.
struct Sample {
  double time_s;  // from the epoch
  Eigen::Vector2d direction;
  Eigen::Matrix2d white;
  Eigen::Vector3d origin;  // [m] ECEF components from the reference's camera centre
  double weight;
};

double seconds_between(std::int64_t later_us, std::int64_t earlier_us) {
  return static_cast<double>(later_us - earlier_us) * 1e-6;
}

// The bearings in a window of the given span. The window is centred on the epoch, or ends at the
// newest bearing if that is earlier.
std::span<const BearingMeasurement> window_of(std::span<const BearingMeasurement> all,
                                              std::int64_t epoch_us, double window_s) {
  const auto span_us = static_cast<std::int64_t>(std::llround(window_s * 1e6));
  const std::int64_t end_us = std::min(all.back().utime_us, epoch_us + span_us / 2);
  const auto first =
      std::ranges::lower_bound(all, end_us - span_us, {}, &BearingMeasurement::utime_us);
  const auto last = std::ranges::upper_bound(all, end_us, {}, &BearingMeasurement::utime_us);
  return {first, last};
}

const BearingMeasurement& nearest(std::span<const BearingMeasurement> window,
                                  std::int64_t epoch_us) {
  return *std::ranges::min_element(window, {}, [&](const BearingMeasurement& measurement) {
    return std::llabs(measurement.utime_us - epoch_us);
  });
}

std::vector<Sample> samples_of(std::span<const BearingMeasurement> window, std::int64_t epoch_us,
                               const BearingMeasurement& reference, const RayFrame& frame,
                               double noise_scale, PlaceAxes& axes) {
  std::vector<Sample> samples;
  for (const BearingMeasurement& measurement : window) {
    const RayFrame own =
        ray_frame(measurement.sight, axes.R_ecef_enu(measurement.sight.origin_ecef));
    const double ahead = frame.direction.dot(own.direction);
    if (ahead <= 0.1) continue;  // not on this tangent plane
    const Eigen::Matrix2d turn = frame.tangent.transpose() * own.tangent;
    const Eigen::Matrix2d white =
        noise_scale * turn * measurement.sight.covariance_white * turn.transpose();
    samples.push_back({seconds_between(measurement.utime_us, epoch_us),
                       frame.tangent.transpose() * own.direction / ahead, white,
                       measurement.sight.origin_ecef - reference.sight.origin_ecef,
                       2.0 / white.trace()});
  }
  return samples;
}

Eigen::Vector3d basis(double time_s) { return {1.0, time_s, time_s * time_s}; }

Eigen::Matrix3d normal_matrix(const std::vector<Sample>& samples) {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  for (const Sample& s : samples) A += s.weight * basis(s.time_s) * basis(s.time_s).transpose();
  return A;
}

Eigen::Matrix<double, 3, 2> coefficients(const std::vector<Sample>& samples,
                                         const Eigen::Matrix3d& A_inverse) {
  Eigen::Matrix<double, 3, 2> right = Eigen::Matrix<double, 3, 2>::Zero();
  for (const Sample& s : samples) {
    right += s.weight * basis(s.time_s) * s.direction.transpose();
  }
  return A_inverse * right;
}

// Prior variance of the quadratic coefficient: from the target's acceleration, plus the curvature
// of the data beyond their noise.
double quadratic_variance(const std::vector<Sample>& samples, const Eigen::Matrix3d& A,
                          double range_m, const AlignmentConfig& config) {
  const double physics = std::pow(config.acceleration_sd_m_s2 / (2.0 * range_m), 2.0);
  if (samples.size() < 4) return physics;
  // In units of the window the matrix is well conditioned.
  const Eigen::DiagonalMatrix<double, 3> unit(1.0, 1.0 / config.window_s,
                                              1.0 / (config.window_s * config.window_s));
  const Eigen::FullPivLU<Eigen::Matrix3d> lu(unit * A * unit);
  if (!lu.isInvertible()) return physics;
  const Eigen::Matrix3d A_inverse = unit * lu.inverse() * unit;
  const double shown = coefficients(samples, A_inverse).row(2).squaredNorm() / 2.0;
  return physics + std::max(0.0, shown - A_inverse(2, 2));
}

// The fit at the epoch: direction and rate on the reference's tangent plane.
struct Fit {
  Eigen::Vector2d direction = Eigen::Vector2d::Zero();
  Eigen::Vector2d rate = Eigen::Vector2d::Zero();
  Eigen::Matrix2d direction_covariance = Eigen::Matrix2d::Zero();
  Eigen::Matrix2d rate_covariance = Eigen::Matrix2d::Zero();
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
};

Fit fit(const std::vector<Sample>& samples, double range_m, const AlignmentConfig& config) {
  Eigen::Matrix3d A = normal_matrix(samples);
  const Eigen::Vector3d prior(0.0, std::pow(config.rate_sd_rad_s, -2.0),
                              1.0 / quadratic_variance(samples, A, range_m, config));
  A += prior.asDiagonal().toDenseMatrix();
  const Eigen::Matrix3d A_inverse = A.inverse();
  // Rows: value and rate at the epoch. Their errors from the priors, then from each bearing.
  const Eigen::Matrix3d from_prior = A_inverse * prior.asDiagonal() * A_inverse;
  Fit result;
  result.direction_covariance.diagonal().setConstant(from_prior(0, 0));
  result.rate_covariance.diagonal().setConstant(from_prior(1, 1));
  for (const Sample& s : samples) {
    const Eigen::Vector3d gain = s.weight * A_inverse * basis(s.time_s);
    result.direction += gain(0) * s.direction;
    result.rate += gain(1) * s.direction;
    result.origin += gain(0) * s.origin;
    result.direction_covariance += gain(0) * gain(0) * s.white;
    result.rate_covariance += gain(1) * gain(1) * s.white;
  }
  return result;
}

// From the reference's tangent plane to the ray's own.
Ray ray_of(const BearingMeasurement& reference, const RayFrame& frame, const Fit& fitted,
           PlaceAxes& axes) {
  Ray ray{.station = reference.station, .sight = reference.sight};
  ray.sight.origin_ecef += fitted.origin;
  const double stretch_squared = 1.0 + fitted.direction.squaredNorm();
  const Eigen::Vector3d direction =
      (frame.direction + frame.tangent * fitted.direction) / std::sqrt(stretch_squared);
  const Eigen::Matrix3d& R = axes.R_ecef_enu(ray.sight.origin_ecef);
  ray.sight.direction = azimuth_elevation_from_enu(R.transpose() * direction);
  const RayFrame own = ray_frame(ray.sight, R);
  const Eigen::Matrix2d turn = own.tangent.transpose() * frame.tangent / std::sqrt(stretch_squared);
  ray.sight.covariance_white = turn * fitted.direction_covariance * turn.transpose();
  ray.rate_rad_s = turn * fitted.rate;
  ray.rate_covariance = turn * fitted.rate_covariance * turn.transpose();
  return ray;
}

bool all_finite(const Ray& ray) {
  return ray.sight.origin_ecef.allFinite() && std::isfinite(ray.sight.direction.azimuth_rad) &&
         std::isfinite(ray.sight.direction.elevation_rad) &&
         ray.sight.covariance_white.allFinite() && ray.sight.covariance_systematic.allFinite() &&
         ray.rate_rad_s.allFinite() && ray.rate_covariance.allFinite();
}

}  // namespace

std::optional<Ray> align(std::span<const BearingMeasurement> measurements, std::int64_t epoch_us,
                         std::optional<double> range_m, const AlignmentConfig& config,
                         double noise_scale) {
  if (measurements.empty()) return std::nullopt;
  const auto window = window_of(measurements, epoch_us, config.window_s);
  if (window.empty()) return std::nullopt;
  const BearingMeasurement& reference = nearest(window, epoch_us);
  if (std::abs(seconds_between(reference.utime_us, epoch_us)) > config.max_age_s) {
    return std::nullopt;
  }
  PlaceAxes axes;
  const RayFrame frame = ray_frame(reference.sight, axes.R_ecef_enu(reference.sight.origin_ecef));
  const auto samples = samples_of(window, epoch_us, reference, frame, noise_scale, axes);
  Ray ray = ray_of(reference, frame, fit(samples, range_m.value_or(config.range_unknown_m), config),
                   axes);
  ray.bearing_variance_rad2 = noise_scale * reference.sight.covariance_white.trace() / 2.0;
  ray.clock_sd_s = reference.clock_sd_s;
  ray.age_s = seconds_between(epoch_us, measurements.back().utime_us);
  ray.belief = 0.0;
  for (const BearingMeasurement& s : window)
    ray.belief += s.belief / static_cast<double>(window.size());
  if (!all_finite(ray)) return std::nullopt;  // one such ray would spoil the joint fit
  return ray;
}

}  // namespace ols::fusion
