// Gives each object an identity. The object keeps its identity when it changes from a bearing-only
// track to a target, or back. Pure.
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
  // same_place: whether a new track takes over the identity of a deleted track only if it is at the
  // deleted track's predicted position.
  explicit TrackIdentities(bool same_place) : same_place_(same_place) {}

  // Assigns an identity to a confirmed track: the identity of a deleted track, else that of the
  // oldest bearing-only track of its stations, else a new one.
  void confirm(Track& track, const std::vector<Track>& tracks);
  // Notes that the bearing's local track belongs to `track`.
  void follow(const BearingMeasurement& measurement, const Track& track);
  // The confirmed track to which this local track belongs; null if there is none.
  Track* follower(const BearingMeasurement& measurement, std::vector<Track>& tracks) const;
  // Whether a track has taken a bearing of this local track within the last within_s.
  bool takes(const BearingMeasurement& newest, std::int64_t now_us, double within_s,
             const std::vector<Track>& tracks) const;
  // Returns the identity of a bearing-only track. The identity is 0 for the first new_after_s, and
  // for a bearing without a local track id. `told`: the identities already published at the same
  // instant; none of them is used twice.
  std::int64_t identify(const BearingMeasurement& newest, double new_after_s,
                        std::set<std::int64_t>& told, const std::vector<Track>& tracks);
  void merge(std::int64_t older, std::int64_t younger) { local_.rename(younger, older); }
  // Keeps a confirmed track that ended, because it may be reacquired.
  void keep_deleted(const Track& track) { deleted_.push_back(track); }
  void forget_deleted(std::int64_t now_us, double after_s);
  // Called when the station's local track ids have new meanings.
  void forget(const std::string& station) { local_.forget(station); }
  // Forgets all deleted and local tracks. The count of identities continues, so that none is ever
  // assigned twice.
  void clear();
  const LocalTracks& local() const { return local_; }

 private:
  bool same_place_;
  std::deque<Track> deleted_;
  std::int64_t next_id_ = 1;
  LocalTracks local_;
};

}  // namespace ols::fusion
