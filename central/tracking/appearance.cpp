#include "central/tracking/appearance.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "central/measurement/ray.h"

namespace ols::fusion {
namespace {

constexpr double kSigmas = 4.0;
constexpr double kLeastM = 0.05, kGreatestM = 80.0, kSizeFactor = 4.0;
constexpr double kBrightnessFactor = 30.0;

struct Speed {
  double mean_m_s = 0.0, variance = 0.0;
};

Speed speed_along(const Eigen::Vector3d& axis, const BearingMeasurement& measurement,
                  double range_m) {
  const Eigen::Vector2d across = ray_frame(measurement.sight).tangent.transpose() * axis;
  const Sighted& seen = measurement.sighted;
  return {range_m * across.dot(seen.rate_rad_s),
          range_m * range_m * across.dot(seen.rate_covariance * across)};
}

bool agree_in_speed(const BearingMeasurement& a, double range_a_m, const BearingMeasurement& b,
                    double range_b_m, const Eigen::Vector3d& plane_normal) {
  if (!a.sighted.has_rate() || !b.sighted.has_rate()) return true;
  const Speed one = speed_along(plane_normal, a, range_a_m);
  const Speed other = speed_along(plane_normal, b, range_b_m);
  return std::abs(one.mean_m_s - other.mean_m_s) <=
         kSigmas * std::sqrt(one.variance + other.variance);
}

// Each size is within two sigmas. The size of a mere point is about its sigma: the object may be
// arbitrarily small.
bool agree_in_size(const Sighted& a, double range_a_m, const Sighted& b, double range_b_m) {
  if (a.size_rad == 0.0 || b.size_rad == 0.0) return true;
  const auto least = [](const Sighted& s) { return std::max(0.0, s.size_rad - 2 * s.size_sd_rad); };
  const auto most = [](const Sighted& s) { return s.size_rad + 2.0 * s.size_sd_rad; };
  const double least_m = std::max(range_a_m * least(a), range_b_m * least(b));
  const double most_m = std::min(range_a_m * most(a), range_b_m * most(b));
  return least_m <= kSizeFactor * most_m && most_m >= kLeastM && least_m <= kGreatestM;
}

bool agree_in_brightness(const Sighted& a, double range_a_m, const Sighted& b, double range_b_m) {
  if (a.signal == 0.0 || b.signal == 0.0) return true;
  const double one = a.signal * range_a_m * range_a_m, other = b.signal * range_b_m * range_b_m;
  return std::max(one, other) <= kBrightnessFactor * std::min(one, other);
}

}  // namespace

bool may_be_same_object(const BearingMeasurement& a, double range_a_m, const BearingMeasurement& b,
                        double range_b_m, const Eigen::Vector3d& plane_normal) {
  return agree_in_size(a.sighted, range_a_m, b.sighted, range_b_m) &&
         agree_in_brightness(a.sighted, range_a_m, b.sighted, range_b_m) &&
         agree_in_speed(a, range_a_m, b, range_b_m, plane_normal);
}

// A tracklet's rate is that of its last moments. A manoeuvring target may have another by now.
double rate_nis(const BearingMeasurement& measurement, const KinematicState& target) {
  constexpr double kManoeuvredM_s = 2.0;
  if (!measurement.sighted.has_rate()) return 0.0;
  const RayFrame frame = ray_frame(measurement.sight);
  const double range_m = (target.mean.head<3>() - measurement.sight.origin_ecef).norm();
  const Eigen::Matrix<double, 2, 3> J = frame.tangent.transpose() / range_m;
  const Eigen::Vector2d off = J * target.mean.segment<3>(3) - measurement.sighted.rate_rad_s;
  Eigen::Matrix2d P = J * target.covariance.block<3, 3>(3, 3) * J.transpose();
  P += measurement.sighted.rate_covariance;
  P.diagonal().array() += std::pow(kManoeuvredM_s / range_m, 2);
  return off.dot(P.ldlt().solve(off));
}

}  // namespace ols::fusion
