#include "central/tracking/unassociated_bearings.h"

#include <algorithm>
#include <cmath>

namespace ols::fusion {

bool BearingSummary::is_near(const Eigen::Vector3d& p_ecef, double more_rad) const {
  const double within = spread_rad + more_rad;
  const Eigen::Vector3d line = p_ecef - origin_ecef;
  return (line.normalized() - direction_ecef).squaredNorm() < within * within;
}

// kLeastRad covers the station's learnt bias: beyond 0.02 rad plus the same multiple of the stated
// errors, a track loses the station anyway (TrackGlance).
BearingSummary summarise(const BearingMeasurement& measurement, const Eigen::Matrix3d& R_ecef_enu) {
  constexpr double kGenerous = 8.0, kLeastRad = 0.05;
  const LineOfSight& sight = measurement.sight;
  const double variance = sight.covariance_white.trace() + sight.covariance_systematic.trace();
  return {.utime_us = measurement.utime_us,
          .origin_ecef = sight.origin_ecef,
          .direction_ecef = R_ecef_enu * enu_from_azimuth_elevation(sight.direction),
          .spread_rad = kLeastRad + kGenerous * std::sqrt(variance),
          .clock_sd_s = measurement.clock_sd_s,
          .track_id = measurement.track_id,
          .is_tracklet = measurement.is_tracklet};
}

void UnassociatedBearings::store(const BearingMeasurement& measurement) {
  Station& own = stations_[measurement.station];
  const auto later =
      std::ranges::upper_bound(own.looks, measurement.utime_us, {}, &BearingSummary::utime_us);
  const auto place = later - own.looks.begin();
  own.bearings.insert(own.bearings.begin() + place, measurement);
  own.looks.insert(later, own.look(measurement));
  const std::int64_t oldest_us = own.looks.back().utime_us - std::llround(span_s_ * 1e6);
  const auto first = std::ranges::lower_bound(own.looks, oldest_us, {}, &BearingSummary::utime_us);
  auto gone = first - own.looks.begin();
  const auto size = static_cast<std::ptrdiff_t>(own.looks.size());
  gone = std::max(gone, size - static_cast<std::ptrdiff_t>(most_));
  own.bearings.erase(own.bearings.begin(), own.bearings.begin() + gone);
  own.looks.erase(own.looks.begin(), own.looks.begin() + gone);
}

void UnassociatedBearings::erase_if(
    const std::string& station, const std::function<bool(const BearingMeasurement&)>& condition) {
  const auto found = stations_.find(station);
  if (found == stations_.end()) return;
  Station& own = found->second;
  std::erase_if(own.bearings, condition);
  if (own.bearings.empty()) {
    stations_.erase(found);
    return;
  }
  if (own.bearings.size() == own.looks.size()) return;
  own.looks.clear();
  for (const BearingMeasurement& measurement : own.bearings)
    own.looks.push_back(own.look(measurement));
}

}  // namespace ols::fusion
