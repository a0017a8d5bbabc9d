#include "central/admission/bearing_check.h"

#include <algorithm>
#include <cmath>

#include "conditions/refusal.h"
#include "geometry/angles.h"

namespace ols::fusion {
namespace {

bool all_finite(const BearingMeasurement& s) {
  return s.sight.origin_ecef.allFinite() && s.sight.origin_sd_enu_m.allFinite() &&
         s.sight.covariance_white.allFinite() && s.sight.covariance_systematic.allFinite() &&
         std::isfinite(s.sight.aim_sd_rad) && std::isfinite(s.sight.direction.azimuth_rad) &&
         std::isfinite(s.sight.direction.elevation_rad) && std::isfinite(s.belief) &&
         std::isfinite(s.clock_sd_s) && s.sighted.rate_rad_s.allFinite() &&
         s.sighted.rate_covariance.allFinite() && std::isfinite(s.sighted.size_rad) &&
         std::isfinite(s.sighted.size_sd_rad) && std::isfinite(s.sighted.across_rad) &&
         std::isfinite(s.sighted.size_noise_rad) && std::isfinite(s.sighted.signal);
}

// NaN is out of range, too.
bool are_probabilities(const std::vector<double>& values) {
  constexpr std::size_t kMost = 64;
  return values.size() <= kMost &&
         std::ranges::all_of(values, [](double p) { return p >= 0.0 && p <= 1.0; });
}

bool sighted_in_range(const Sighted& s) {
  constexpr double kGreatestRadS = 100.0, kGreatestSignal = 1e9;
  const Eigen::Matrix2d& P = s.rate_covariance;
  return s.rate_rad_s.norm() <= kGreatestRadS && P(0, 0) >= 0.0 && P(1, 1) >= 0.0 &&
         P(0, 1) * P(0, 1) <= P(0, 0) * P(1, 1) && s.size_rad >= 0.0 && s.size_rad <= kPi &&
         s.size_sd_rad >= 0.0 && s.size_sd_rad <= kPi && s.across_rad >= 0.0 &&
         s.across_rad <= kPi && s.size_noise_rad >= 0.0 && s.size_noise_rad <= kPi &&
         s.signal >= 0.0 && s.signal <= kGreatestSignal && are_probabilities(s.class_probability);
}

bool in_range(const BearingMeasurement& s) {
  constexpr double kGreatestClockSdS = 1e4;
  const AzimuthElevation& d = s.sight.direction;
  return !s.station.empty() && s.utime_us > 0 && d.azimuth_rad >= 0.0 &&
         d.azimuth_rad <= 2.0 * kPi && std::abs(d.elevation_rad) <= kPi / 2.0 && s.belief >= 0.0 &&
         s.belief <= 1.0 && s.clock_sd_s >= 0.0 && s.clock_sd_s <= kGreatestClockSdS &&
         s.image_bearings >= 0 && sighted_in_range(s.sighted) &&
         is_a_stations_place(s.sight.origin_ecef, s.sight.origin_sd_enu_m);
}

// A received matrix may be asymmetric: uses the larger of its two off-diagonal elements.
double determinant(const Eigen::Matrix2d& m) {
  const double off = std::max(std::abs(m(0, 1)), std::abs(m(1, 0)));
  return m(0, 0) * m(1, 1) - off * off;
}

bool variances_within(const Eigen::Matrix2d& m, double least_rad2) {
  constexpr double kGreatestRad2 = 10.0;  // about (180 deg)^2: the direction is unknown
  return m.diagonal().minCoeff() >= least_rad2 && m.diagonal().maxCoeff() <= kGreatestRad2;
}

// Real cameras stay far inside these bounds. A bearing outside them would make the whole fit
// ill-conditioned.
bool covariances_hold(const LineOfSight& sight) {
  constexpr double kLeastWhiteRad2 = 1e-18;
  constexpr double kWorstCondition = 1e8;  // white part: largest eigenvalue over smallest
  const Eigen::Matrix2d& white = sight.covariance_white;
  const Eigen::Matrix2d& stays = sight.covariance_systematic;
  constexpr double kRounding = 1e-9;
  const double aim = (1.0 - kRounding) * sight.aim_sd_rad * sight.aim_sd_rad;
  const double slack = kRounding * stays(0, 0) * stays(1, 1);  // rounding of a singular matrix
  return variances_within(white, kLeastWhiteRad2) && variances_within(stays, 0.0) &&
         sight.aim_sd_rad >= 0.0 && aim <= stays.diagonal().minCoeff() &&
         determinant(white) >= white.trace() * white.trace() / kWorstCondition &&
         determinant(stays) >= -slack;
}

}  // namespace

const char* to_string(BearingRefusal refusal) {
  switch (refusal) {
    case BearingRefusal::kNone:
      return "none";
    case BearingRefusal::kNotFinite:
      return "refused_not_finite";
    case BearingRefusal::kOutOfRange:
      return "refused_out_of_range";
    case BearingRefusal::kCovariance:
      return "refused_covariance";
    case BearingRefusal::kUnknown:
      return "refused_unknown_station";
    case BearingRefusal::kStale:
      return "refused_stale";
    case BearingRefusal::kFuture:
      return "refused_future";
    case BearingRefusal::kDuplicate:
      return "refused_duplicate";
    case BearingRefusal::kQuarantine:
      return "refused_quarantine";
    case BearingRefusal::kTooMany:
      return "refused_too_many_stations";
    case BearingRefusal::kFlood:
      return "refused_flood";
    case BearingRefusal::kLowBelief:
      return "unused_low_belief";
    case BearingRefusal::kCount:
      break;
  }
  return "unknown";
}

std::string_view in_words(BearingRefusal refusal) {
  const std::string_view sentence = refusal_sentence(to_string(refusal));
  return sentence.empty() ? to_string(refusal) : sentence;
}

bool is_a_stations_place(const Eigen::Vector3d& p_ecef, const Eigen::Vector3d& sd_enu_m) {
  constexpr double kDeepestM = 6.3e6, kHighestM = 7.0e6;  // from the Earth's centre
  constexpr double kGreatestSdM = 1e6;
  return p_ecef.norm() > kDeepestM && p_ecef.norm() < kHighestM && sd_enu_m.minCoeff() >= 0.0 &&
         sd_enu_m.maxCoeff() <= kGreatestSdM;
}

BearingRefusal check(const BearingMeasurement& measurement) {
  if (!all_finite(measurement)) return BearingRefusal::kNotFinite;
  if (!in_range(measurement)) return BearingRefusal::kOutOfRange;
  if (!covariances_hold(measurement.sight)) return BearingRefusal::kCovariance;
  return BearingRefusal::kNone;
}

}  // namespace ols::fusion
