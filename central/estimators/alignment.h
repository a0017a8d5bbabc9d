// Bearings of stations that do not expose at the same instant, brought to a common time.
//
// Each station's directions over a short window are fitted by a polynomial on the tangent plane
// (gnomonic), least squares, and evaluated at the epoch: between bearings where there are later
// ones, beyond the last one up to a limit. The order follows the data: the quadratic term carries a
// prior of zero mean whose size is what the bearings themselves show beyond their noise, plus what
// a target may accelerate; a single bearing leaves the rate to its prior. What the polynomial
// cannot know is thus in the covariance.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "central/measurement/bearing_measurement.h"
#include "central/measurement/ray.h"

namespace ols::fusion {

struct AlignmentConfig {
  double window_s = 0.3;              // span of the bearings that are fitted
  double max_age_s = 0.3;             // no ray where no bearing is nearer to the epoch than this
  double rate_sd_rad_s = 1.0;         // prior of the angular rate
  double acceleration_sd_m_s2 = 5.0;  // prior of the target's acceleration
  double range_unknown_m = 50.0;      // stands for the range until there is a position
};

// One station's bearings, in order of time -> its ray at the epoch; nothing when there is none
// near. range_m: distance to the target as far as known, for the prior of its angular acceleration.
// noise_scale: the variance of the bearings' noise over the one that they state.
std::optional<Ray> align(std::span<const BearingMeasurement> sightings, std::int64_t epoch_us,
                         std::optional<double> range_m, const AlignmentConfig& config = {},
                         double noise_scale = 1.0);

}  // namespace ols::fusion
