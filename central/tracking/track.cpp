#include "central/tracking/track.h"

#include <algorithm>

namespace ols::fusion {

const char* to_string(TrackState state) {
  switch (state) {
    case TrackState::kTentative:
      return "born";
    case TrackState::kConfirmed:
      return "confirmed";
    case TrackState::kCoasted:
      return "coasted";
    case TrackState::kDropped:
      return "dropped";
  }
  return "unknown";
}

bool Track::has_taken(const BearingMeasurement& sighting) const {
  const auto own = bearings.find(sighting.station);
  if (own == bearings.end()) return false;
  const auto& taken = own->second;
  const auto at =
      std::ranges::lower_bound(taken, sighting.utime_us, {}, &BearingMeasurement::utime_us);
  return at != taken.end() && at->utime_us == sighting.utime_us;
}

bool is_established(const Track& track) {
  return track.state == TrackState::kConfirmed || track.state == TrackState::kCoasted;
}

}  // namespace ols::fusion
