#include "central/tracking/behind_land.h"

#include "central/ground/visibility.h"
#include "central/measurement/activity.h"
#include "central/tracking/position_guard.h"

namespace ols::fusion {

bool is_behind_land(const TrackFilter& filter, const land::Surface* surface) {
  if (surface == nullptr || stations_lately(filter, Activity::kSupportsS) > 2) return false;
  const Eigen::Vector3d p_ecef = filter.position();
  const Eigen::Matrix3d P = filter.summary().covariance.topLeftCorner<3, 3>();
  bool is_behind = false;
  filter.each_station([&](const FilterStation& station) {
    if (station.used == 0 || is_behind ||
        !station.last_used.within(Activity::kSupportsS, filter.utime_us()))
      return;
    is_behind = plausibility(*surface, station.sight.origin_ecef, p_ecef, P) < kImplausible;
  });
  return is_behind;
}

}  // namespace ols::fusion
