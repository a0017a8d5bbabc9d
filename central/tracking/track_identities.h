// Which identity an object has: as a track, and before and after that as a station's line. Pure.
#pragma once

#include <cstdint>
#include <deque>
#include <set>
#include <string>
#include <vector>

#include "central/tracking/local_tracks.h"
#include "central/tracking/track.h"

namespace ols::fusion {

class TrackIdentities {
 public:
  // same_place: an identity of a dropped track is taken over only where that must be by now.
  explicit TrackIdentities(bool same_place) : same_place_(same_place) {}

  // Gives a track that is confirmed its identity: that of a dropped track, or that of the oldest
  // line of its stations, or a new one.
  void confirm(Track& track, const std::vector<Track>& tracks);
  // The track takes what the station follows by this name.
  void follow(const BearingMeasurement& sighting, const Track& track);
  // The sure track that the station follows by this name; null: none.
  Track* follower(const BearingMeasurement& sighting, std::vector<Track>& tracks) const;
  // Whether a track takes what the station follows by this name: the last bearing not longer ago.
  bool takes(const BearingMeasurement& newest, std::int64_t now_us, double within_s,
             const std::vector<Track>& tracks) const;
  // A line's: 0 for the first new_after_s, and for what the station does not name. `told`: those of
  // others at the same instant; one id is one object.
  std::int64_t identify(const BearingMeasurement& newest, double new_after_s,
                        std::set<std::int64_t>& told, const std::vector<Track>& tracks);
  void merge(std::int64_t older, std::int64_t younger) { local_.rename(younger, older); }
  // A confirmed track ended: it may be found again.
  void drop(const Track& track) { dropped_.push_back(track); }
  void forget_dropped(std::int64_t now_us, double after_s);
  // A station's names mean something else from now on.
  void forget(const std::string& station) { local_.forget(station); }
  // Everything but which identities are given away.
  void clear();
  const LocalTracks& local() const { return local_; }

 private:
  bool same_place_;
  std::deque<Track> dropped_;
  std::int64_t next_id_ = 1;
  LocalTracks local_;
};

}  // namespace ols::fusion
