#include "central/tracking/track_identities.h"

#include <algorithm>

#include "central/measurement/time_span.h"
#include "central/tracking/likeness.h"

namespace ols::fusion {
namespace {

bool is_alive(std::int64_t id, const std::vector<Track>& tracks) {
  return std::ranges::any_of(tracks,
                             [&](const Track& t) { return is_established(t) && t.id == id; });
}

}  // namespace

void TrackIdentities::confirm(Track& track, const std::vector<Track>& tracks) {
  const KinematicState own = track.filter.at(track.filter.utime_us());
  // A deleted track that is predicted to be here passes on its identity.
  const auto before = std::ranges::find_if(deleted_, [&](const Track& old) {
    return !same_place_ || is_same_place(own, old.filter.at(own.utime_us));
  });
  if (before != deleted_.end()) {
    track.id = before->id;
  } else {
    for (const auto& [station, bearings] : track.bearings) {
      if (bearings.empty() || bearings.back().track_id == 0) continue;
      const LocalTracks::Object* const line = local_.find(bearings.back());
      if (line == nullptr || line->id == 0 || is_alive(line->id, tracks)) continue;
      track.id = track.id == 0 ? line->id : std::min(track.id, line->id);
    }
  }
  if (track.id == 0) track.id = next_id_++;
  std::erase_if(deleted_, [&](const Track& old) { return old.id == track.id; });
}

void TrackIdentities::follow(const BearingMeasurement& measurement, const Track& track) {
  if (measurement.track_id == 0 || track.id == 0) return;
  LocalTracks::Object& own = local_.at(measurement);
  own.id = track.id;
  own.given_us = std::max(own.given_us, measurement.utime_us);
}

Track* TrackIdentities::follower(const BearingMeasurement& measurement,
                                 std::vector<Track>& tracks) const {
  if (measurement.track_id == 0) return nullptr;
  const LocalTracks::Object* const own = local_.find(measurement);
  if (own == nullptr) return nullptr;
  const auto track = std::ranges::find_if(
      tracks, [&](const Track& t) { return is_established(t) && t.id == own->id; });
  return track == tracks.end() ? nullptr : &*track;
}

bool TrackIdentities::takes(const BearingMeasurement& newest, std::int64_t now_us, double within_s,
                            const std::vector<Track>& tracks) const {
  const LocalTracks::Object* const own = local_.find(newest);
  return own != nullptr && is_alive(own->id, tracks) && seconds(now_us - own->given_us) < within_s;
}

std::int64_t TrackIdentities::identify(const BearingMeasurement& newest, double new_after_s,
                                       std::set<std::int64_t>& told,
                                       const std::vector<Track>& tracks) {
  if (newest.track_id == 0) return 0;
  LocalTracks::Object& own = local_.at(newest);
  if (own.id != 0 && (is_alive(own.id, tracks) || told.contains(own.id))) {
    own.id = 0;
    own.since_us = newest.utime_us;
  }
  if (own.id == 0) {
    if (seconds(newest.utime_us - own.since_us) < new_after_s) return 0;
    own.id = next_id_++;
  }
  told.insert(own.id);
  return own.id;
}

void TrackIdentities::forget_deleted(std::int64_t now_us, double after_s) {
  std::erase_if(deleted_, [&](const Track& old) {
    return same_place_ && seconds(now_us - old.last_two_station_us) > after_s;
  });
  while (deleted_.size() > 64) deleted_.pop_front();
}

void TrackIdentities::clear() {
  deleted_.clear();
  local_ = {};
}

}  // namespace ols::fusion
