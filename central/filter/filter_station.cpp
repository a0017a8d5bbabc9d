#include "central/filter/filter_station.h"

#include <algorithm>

#include "geometry/wgs84.h"

namespace ols::fusion {

void FilterStation::note_use(const BearingMeasurement& measurement, double nis,
                             double used_weight) {
  rejected = 0;
  weight = used_weight;
  if (sight.origin_ecef != measurement.sight.origin_ecef) {
    R_ecef_enu = ols::R_ecef_enu(measurement.sight.origin_ecef);
  }
  sight = measurement.sight;
  last_used.note(measurement.utime_us);
  ++used;
  mean_nis += 0.05 * (nis - mean_nis);
}

bool is_redundant(const std::vector<FilterStation>& stations, const FilterStation& entry) {
  if (!entry.sight.covariance_systematic.isZero(0.0)) return true;
  const auto delivers = [&](const FilterStation& station) {
    return station.used > 0 &&
           station.last_used.within(Activity::kFollowsS, entry.last_used.last_us);
  };
  return std::ranges::count_if(stations, delivers) > 2;
}

}  // namespace ols::fusion
