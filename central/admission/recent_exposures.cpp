#include "central/admission/recent_exposures.h"

#include <algorithm>

#include "central/measurement/time_span.h"

namespace ols::fusion {
namespace {

constexpr double kMemoryS = 1.0;

}  // namespace

bool RecentExposures::has(const BearingMeasurement& measurement) const {
  const auto at =
      std::ranges::lower_bound(exposures_, measurement.utime_us, {}, &Exposure::utime_us);
  const auto end =
      std::ranges::upper_bound(exposures_, measurement.utime_us, {}, &Exposure::utime_us);
  const AzimuthElevation& d = measurement.sight.direction;
  return std::any_of(at, end, [&](const Exposure& e) {
    const bool same_way =
        e.direction.azimuth_rad == d.azimuth_rad && e.direction.elevation_rad == d.elevation_rad;
    return same_way || (measurement.track_id != 0 && e.track_id == measurement.track_id);
  });
}

void RecentExposures::go_on_to(std::int64_t utime_us) {
  const std::int64_t newest_us =
      exposures_.empty() ? utime_us : std::max(utime_us, exposures_.back().utime_us);
  const auto first = std::ranges::lower_bound(
      exposures_, newest_us - static_cast<std::int64_t>(kMemoryS * 1e6), {}, &Exposure::utime_us);
  exposures_.erase(exposures_.begin(), first);
}

bool RecentExposures::is_flood(double flood_hz) const {
  return static_cast<double>(exposures_.size()) >= flood_hz * kMemoryS;
}

void RecentExposures::add(const BearingMeasurement& measurement) {
  const auto later =
      std::ranges::upper_bound(exposures_, measurement.utime_us, {}, &Exposure::utime_us);
  exposures_.insert(later,
                    {measurement.utime_us, measurement.sight.direction, measurement.track_id});
  const double span_s = seconds(exposures_.back().utime_us - exposures_.front().utime_us);
  rate_hz_ = span_s > 0.0 ? static_cast<double>(exposures_.size() - 1) / span_s : 0.0;
}

}  // namespace ols::fusion
