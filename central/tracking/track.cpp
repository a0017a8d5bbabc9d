#include "central/tracking/track.h"

#include <algorithm>

namespace ols::fusion {

void LastOfKind::note(const BearingMeasurement& measurement) {
  std::int64_t& of_kind = measurement.is_tracklet ? tracklet_us : tracker_us;
  of_kind = std::max(of_kind, measurement.utime_us);
  if (measurement.sighted.has_appearance())
    appearance_us = std::max(appearance_us, measurement.utime_us);
}

bool Track::has_taken(const BearingMeasurement& measurement, std::int64_t within_us) const {
  const auto own = bearings.find(measurement.station);
  if (own == bearings.end()) return false;
  const auto& taken = own->second;
  const std::int64_t from_us = measurement.utime_us - within_us;
  // Most bearings are newer than all taken ones. This avoids a search, which would fetch many
  // bearings from memory.
  if (taken.empty() || taken.back().utime_us < from_us) return false;
  const auto at = std::ranges::lower_bound(taken, from_us, {}, &BearingMeasurement::utime_us);
  return at->utime_us <= measurement.utime_us + within_us;
}

bool is_established(const Track& track) {
  return track.state == TrackState::kConfirmed || track.state == TrackState::kCoasting;
}

}  // namespace ols::fusion
