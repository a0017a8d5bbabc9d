// Several targets: which bearing belongs to which object, and which objects there are. Pure.
//
// The rules (docs/fusion.md tells them at length):
//  - A bearing goes to the confirmed track that explains it best, or else to the best of those that
//    are only born; within one exposure of one station a track takes one bearing.
//  - A bearing that two confirmed tracks explain about as well (they cross in that station's view)
//    goes to none: the other stations tell them apart.
//  - What no track explains is kept for births (track_birth.h).
//  - born -> confirmed: three stations have given two bearings each, or two stations five each
//    for confirm_s, most of what they gave being explained, and the position is one.
//  - born -> dropped: no two stations have seen it for born_drop_s; or it is another track's
//  double.
//  - confirmed -> coasted: no two stations have seen it for coast_s. coasted -> confirmed: two
//  have.
//  - coasted -> dropped: no two stations for drop_s; or for coast_s, when one is set aside all the
//    time and no two others agree.
//  - any -> dropped: two stations alone, whose rays meet only by more than they state.
//  - two confirmed ones -> one: they have been one object for a second (track_rivals.h).
//  - A track that is confirmed where one that was dropped must be by now has its identity; or else
//    that of the line which one of its stations has followed.
//
// In a recording of one object (one_target) every bearing is offered to the one track, and:
//  - Two rays begin it, on trial, and it is confirmed when its position is one. It is proved by a
//    start as it would need among several objects, from the same bearings. If a bearing does not
//    fit before, it is taken back with all that it has taught, and for doubt_s only such a start
//    begins one.
//  - When two stations or more, and half of all, are set aside most of the time, a start on which
//    more stations agree takes its place.
//  - coasted -> dropped: as above, and half of the stations are set aside, or its position is none
//    any more, or there is nothing at all for drop_s.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "central/tracking/followed_objects.h"
#include "central/tracking/track.h"
#include "central/tracking/track_birth.h"
#include "central/tracking/track_rivals.h"

namespace ols {

struct KeeperConfig {
  bool one_target = false;  // a recording of one object
  double doubt_s = 1.0;     // two rays do not begin its track so soon after they were wrong
  int max_tracks = 256;     // born ones included
  int confirm_stations = 3;
  int confirm_hits = 2;       // of each of them
  int confirm_pair_hits = 5;  // of each of two, where only two see it
  double confirm_s = 0.7;
  double born_drop_s = 0.4;
  double seen_s = Activity::kDeliversS;  // a station's last bearing is not older
  double coast_s = 0.5;
  double drop_s = 2.0;
  double remember_s = 5.0;     // the identity of a dropped one
  double ambiguous_nis = 9.0;  // difference of two tracks' normalised residuals
  double memory_s = 1.0;       // bearings kept for the estimators without memory
  BirthConfig birth{};
  FilterConfig filter{};
  StationErrorsConfig errors{};
  RivalsConfig rivals{};
};

// What became of a bearing.
struct Association {
  enum class Kind { kTrack, kAmbiguous, kUnexplained, kSetAside };
  Kind kind = Kind::kUnexplained;
  std::int64_t track_id = 0;  // 0: none, or one that is not confirmed yet
};

class TrackKeeper {
 public:
  explicit TrackKeeper(const KeeperConfig& config);

  // may_begin: whether it may take part in the birth of a track.
  Association add(const Sighting& sighting, bool may_begin = true);
  // Lives and deaths, by the fusion's time.
  void advance(std::int64_t now_us);
  void forget_station(const std::string& station);
  // Which object it follows: its ids mean something else from now on.
  void forget_followed(const std::string& station) { followed_.forget(station); }
  void clear();

  const std::vector<Track>& tracks() const { return tracks_; }
  const StationErrors& errors() const { return errors_; }
  StationErrors& errors() { return errors_; }
  // Of a recording's one object: has a start of several stations agreed with its track?
  bool proved() const { return proved_; }
  const TrackBirth& births() const { return birth_; }
  // The identity of what a station follows by its own word (the bearing's track_id) and no track
  // explains: it is the target's that it was, and becomes that of the target which it turns out to
  // be. 0 for the first confirm_s, while ordinary targets are found, and for what it does not name.
  // `told`: those of others at the same instant; one id is one object.
  std::int64_t identify(const Sighting& newest, std::set<std::int64_t>& told);
  // Whether a track takes what the station follows by this name: the last bearing not longer ago.
  bool takes(const Sighting& newest, std::int64_t now_us, double within_s) const;
  const FollowedObjects& followed() const { return followed_; }
  struct Counts {
    std::int64_t born = 0, confirmed = 0, dropped = 0, merged = 0, ambiguous = 0, set_aside = 0,
                 unexplained = 0;
  };
  const Counts& counts() const { return counts_; }
  // The confirmed track that a station's bearing would have to be moved least for, and by how much
  // (predicted minus measured, cross-elevation and elevation).
  struct Nearest {
    std::int64_t track_id = 0;
    Eigen::Vector2d off_rad = Eigen::Vector2d::Zero();
  };
  std::optional<Nearest> nearest(const Sighting& sighting) const;

 private:
  struct Candidate {
    std::size_t track = 0;
    Innovation seen;
  };
  // What a quick look needs, side by side: a whole track fills the cache by itself.
  struct Glance {
    std::int64_t utime_us = 0;
    Eigen::Vector3d p_ecef, v_ecef;
    double position_sd_m = 0.0, velocity_sd_m_s = 0.0;
    bool may_see(const Sighting& sighting, const Eigen::Vector3d& direction_ecef) const;
  };
  static Glance glance_at(const Track& track);
  std::vector<Candidate> candidates(const Sighting& sighting, bool confirmed) const;
  Association begin(const Sighting& sighting);
  Association add_to_one(const Sighting& sighting, bool may_begin);
  void note(const Sighting& sighting, bool used);
  void take_back(std::int64_t utime_us);
  void prove(const Sighting& sighting);
  bool is_better(const Track& start) const;
  int stations(bool explained) const;
  bool doubted() const;
  void note_rivals(const Sighting& sighting, const std::vector<Candidate>& near);
  Association give_to(Track& track, const Sighting& sighting, const Innovation* seen = nullptr);
  Track* follower(const Sighting& sighting);
  void consider(Track& track);
  bool worth_confirming(const Track& track) const;
  static bool are_alike(const Track& track, const Track& other);
  bool is_double(const Track& track) const;
  void confirm(Track& track);
  void follow(const Sighting& sighting, const Track& track);
  void merge(std::int64_t older, std::int64_t younger);
  void take_identity(Track& track);
  bool is_alive(std::int64_t id) const;
  void keep(Track& track, const Sighting& sighting) const;
  void age(Track& track, std::int64_t now_us);
  void forget_what_it_taught(const Track& track);

  KeeperConfig config_;
  TrackBirth birth_;
  StationErrors errors_;
  TrackRivals rivals_;
  std::vector<Track> tracks_;
  std::vector<Glance> glances_;  // of each track
  std::deque<Track> dropped_;    // confirmed ones, for their identities
  std::int64_t next_id_ = 1;
  FollowedObjects followed_;
  Counts counts_;
  // Of a recording's one object: which share of a station's bearings its track explains, lately.
  struct Explains {
    std::int64_t newest_us = 0;
    double share = 1.0;
  };
  std::map<std::string, Explains> explains_;
  bool proved_ = false;
  StationErrors errors_before_;                // the track on trial
  std::optional<std::int64_t> taken_back_us_;  // when one was, last
};

}  // namespace ols
