// Which identity an object has: as a track, and before and after that as a line.
#include <Eigen/Cholesky>
#include <algorithm>

#include "central/time_span.h"
#include "central/track_keeper.h"

namespace ols {

bool TrackKeeper::is_alive(std::int64_t id) const {
  return std::ranges::any_of(tracks_, [&](const Track& t) { return is_sure(t) && t.id == id; });
}

// That of a dropped track which must be there by now; or that of the oldest line of its stations;
// or a new one.
void TrackKeeper::take_identity(Track& track) {
  const KinematicState own = track.filter.at(track.filter.utime_us());
  const auto must_be_there = [&](const Track& old) {
    const KinematicState there = old.filter.at(own.utime_us);
    const Eigen::Vector3d off = (own.mean - there.mean).head<3>();
    const Eigen::Matrix3d P = (own.covariance + there.covariance).topLeftCorner<3, 3>();
    constexpr double kThere = 11.3;  // chi^2 of 3 degrees of freedom, 0.99
    return config_.one_target || off.dot(P.ldlt().solve(off)) <= kThere;
  };
  const auto before = std::ranges::find_if(dropped_, must_be_there);
  if (before != dropped_.end()) {
    track.id = before->id;
  } else {
    for (const auto& [station, bearings] : track.bearings) {
      const auto line = followed_.find(station);
      if (bearings.empty() || line == followed_.end()) continue;
      const auto& [station_track, id, since_us] = line->second;
      if (id == 0 || station_track != bearings.back().track_id || is_alive(id)) continue;
      track.id = track.id == 0 ? id : std::min(track.id, id);
    }
  }
  if (track.id == 0) track.id = next_id_++;
  std::erase_if(dropped_, [&](const Track& old) { return old.id == track.id; });
}

std::int64_t TrackKeeper::identify(const Sighting& newest, std::set<std::int64_t>& told) {
  if (newest.track_id == 0) return 0;
  const auto [position, is_new] = followed_.try_emplace(newest.station);
  Followed& own = position->second;
  const bool other = own.station_track != newest.track_id;
  if (is_new || other || (own.id != 0 && (is_alive(own.id) || told.contains(own.id)))) {
    own = {newest.track_id, 0, newest.utime_us};
  }
  if (own.id == 0) {
    if (seconds(newest.utime_us - own.since_us) < config_.confirm_s) return 0;
    own.id = next_id_++;
  }
  told.insert(own.id);
  return own.id;
}

}  // namespace ols
