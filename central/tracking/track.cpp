#include "central/tracking/track.h"

#include <algorithm>

namespace ols::fusion {

bool Track::has_taken(const BearingMeasurement& measurement) const {
  const auto own = bearings.find(measurement.station);
  if (own == bearings.end()) return false;
  const auto& taken = own->second;
  // Most bearings are newer than all; to search each station's would fetch many from memory.
  if (taken.empty() || taken.back().utime_us < measurement.utime_us) return false;
  const auto at =
      std::ranges::lower_bound(taken, measurement.utime_us, {}, &BearingMeasurement::utime_us);
  return at->utime_us == measurement.utime_us;
}

bool is_established(const Track& track) {
  return track.state == TrackState::kConfirmed || track.state == TrackState::kCoasting;
}

}  // namespace ols::fusion
