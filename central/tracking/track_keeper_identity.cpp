// Which identity an object has: as a track, and before and after that as a line.
#include <Eigen/Cholesky>
#include <algorithm>

#include "central/measurement/time_span.h"
#include "central/tracking/track_keeper.h"

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
      if (bearings.empty() || bearings.back().track_id == 0) continue;
      const FollowedObjects::Object* const line = followed_.find(bearings.back());
      if (line == nullptr || line->id == 0 || is_alive(line->id)) continue;
      track.id = track.id == 0 ? line->id : std::min(track.id, line->id);
    }
  }
  if (track.id == 0) track.id = next_id_++;
  std::erase_if(dropped_, [&](const Track& old) { return old.id == track.id; });
}

// The track takes what the station follows by this name.
void TrackKeeper::follow(const Sighting& sighting, const Track& track) {
  if (sighting.track_id == 0 || track.id == 0) return;
  FollowedObjects::Object& own = followed_.at(sighting);
  own.id = track.id;
  own.given_us = std::max(own.given_us, sighting.utime_us);
}

bool TrackKeeper::takes(const Sighting& newest, std::int64_t now_us, double within_s) const {
  const FollowedObjects::Object* const own = followed_.find(newest);
  return own != nullptr && is_alive(own->id) && seconds(now_us - own->given_us) < within_s;
}

// Two tracks are one object. The one stays that has more of its bearings, with the older identity.
void TrackKeeper::merge(std::int64_t older, std::int64_t younger) {
  rivals_.forget(younger);
  const auto own = std::ranges::find(tracks_, older, &Track::id);
  const auto other = std::ranges::find(tracks_, younger, &Track::id);
  if (own == tracks_.end() || other == tracks_.end() || !is_sure(*own) || !is_sure(*other)) return;
  const auto bearings = [](const Track& track) {
    std::size_t sum = 0;
    for (const auto& [station, kept] : track.bearings) sum += kept.size();
    return sum;
  };
  if (bearings(*other) > bearings(*own)) std::swap(*own, *other);
  own->id = older;
  other->id = 0;
  other->state = TrackState::kDropped;
  followed_.rename(younger, older);
  ++counts_.merged;
}

std::int64_t TrackKeeper::identify(const Sighting& newest, std::set<std::int64_t>& told) {
  if (newest.track_id == 0) return 0;
  FollowedObjects::Object& own = followed_.at(newest);
  if (own.id != 0 && (is_alive(own.id) || told.contains(own.id))) {
    own.id = 0;
    own.since_us = newest.utime_us;
  }
  if (own.id == 0) {
    if (seconds(newest.utime_us - own.since_us) < config_.confirm_s) return 0;
    own.id = next_id_++;
  }
  told.insert(own.id);
  return own.id;
}

}  // namespace ols
