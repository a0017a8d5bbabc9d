// Aligns the bearings of stations that do not expose at the same instant to a common time.
//
// A polynomial is fitted by least squares to each station's directions over a short window, on the
// tangent plane (gnomonic), and evaluated at the epoch. If there are bearings after the epoch, the
// polynomial interpolates; otherwise it extrapolates, up to max_age_s. The quadratic term has a
// prior of zero mean. The prior's variance is the curvature that the bearings show beyond their
// noise, plus the curvature from a possible acceleration. The covariance of the result therefore
// contains the error of the polynomial model. With a single bearing, the rate keeps its prior.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "central/measurement/bearing_measurement.h"
#include "central/measurement/ray.h"

namespace ols::fusion {

struct AlignmentConfig {
  double window_s = 0.3;       // time span of the fitted bearings
  double max_age_s = 0.3;      // a station without a bearing this close to the epoch gives no ray
  double rate_sd_rad_s = 1.0;  // 1-sigma of the prior of the angular rate
  double acceleration_sd_m_s2 = 5.0;  // 1-sigma of the target's possible acceleration
  double range_unknown_m = 50.0;      // assumed range while the position is unknown
};

// Takes one station's bearings, in order of time. Returns its ray at the epoch, or nullopt if there
// is no bearing near the epoch. range_m: the distance to the target, if known; it determines the
// prior of the angular acceleration. noise_scale: the ratio of actual to stated noise variance.
std::optional<Ray> align(std::span<const BearingMeasurement> measurements, std::int64_t epoch_us,
                         std::optional<double> range_m, const AlignmentConfig& config = {},
                         double noise_scale = 1.0);

}  // namespace ols::fusion
