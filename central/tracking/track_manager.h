// The life cycle of tracks (docs/fusion.md, "The life of a track"). Two classes derive from
// TrackManager: LiveTracks (live_tracks.h), and RecordedTrack for the only track of a recording
// (recorded_track.h). They define the criteria for confirmation and loss. Pure.
//
//  - tentative -> confirmed: the track meets the criteria, and is no duplicate of a confirmed
//    track.
//  - confirmed -> coasting: fewer than two stations have seen the track for coast_s. coasting ->
//    confirmed: two stations see it again.
//  - any -> deleted: only two stations see the track, and either they are an inconsistent pair
//    (their rays intersect only if their biases are larger than stated), or their rays intersect
//    below or behind the ground (behind_land.h).
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "central/measurement/activity.h"
#include "central/tracking/duplicate_tracks.h"
#include "central/tracking/track.h"
#include "central/tracking/track_glance.h"
#include "central/tracking/track_identities.h"
#include "central/tracking/track_initiation.h"

namespace ols::fusion {

struct TrackManagerConfig {
  int max_tracks = 256;  // including tentative tracks
  int confirm_stations = 3;
  int confirm_hits = 2;  // required bearings of each of these stations
  // Required bearings of each of two stations, if only two see the target.
  int confirm_pair_hits = 5;
  double confirm_s = 0.7;
  double chance_pairs_a_day = 1.0;  // largest expected number per day of ghosts from two stations
  double tentative_delete_s = 0.4;
  double coast_s = 0.5;
  double drop_s = Activity::kSupportsS;
  double remember_s = 5.0;  // how long the identity of a deleted track is kept
  // A bearing is ambiguous if the sums of the NIS of the two best assignments differ by less.
  double ambiguous_nis = 9.0;
  double memory_s = 1.0;  // how long bearings are kept, for estimators that have no state
  InitiationConfig initiation{};
  FilterConfig filter{};
  BiasModelConfig errors{};
  DuplicatesConfig duplicates{};
};

// The fate of a bearing.
struct Association {
  enum class Kind { kTrack, kAmbiguous, kUnexplained, kRejected };
  Kind kind = Kind::kUnexplained;
  std::int64_t track_id = 0;  // 0 if there is no track, or if it is tentative
};

class TrackManager {
 public:
  virtual ~TrackManager() = default;

  // Takes the bearings of one image, each of a different object. Returns their fates in the same
  // order. may_begin: whether they may take part in track initiation.
  virtual std::vector<Association> add(std::span<const BearingMeasurement> image,
                                       bool may_begin) = 0;
  Association add(const BearingMeasurement& measurement, bool may_begin = true) {
    return add(std::span(&measurement, 1), may_begin).front();
  }
  // Updates the tracks' states to the fusion's time.
  void advance(std::int64_t now_us);
  void forget_station(const std::string& station);
  // Called when a station has a new calibration: forgets what is known about its errors.
  void forget_errors(const std::string& station) { errors_.forget(station); }
  // Called when the station's local track ids have new meanings.
  void forget_followed(const std::string& station) { identities_.forget(station); }

  const std::vector<Track>& tracks() const { return tracks_; }
  const BiasModel& errors() const { return errors_; }
  // Starts from the station errors that another run has learnt.
  void set_errors(const BiasModel& errors) { errors_ = errors; }
  const UnassociatedBearings& unassociated() const { return initiation_.pool(); }
  // Why the last bearing began no track, and why there is no track at this instant.
  Solution why_no_track_began() const { return initiation_.why_no_track(); }
  Solution why_none(std::int64_t now_us) const { return initiation_.why_none(now_us); }
  // Whether no target is published because the objects that two stations see can be paired in
  // several ways.
  virtual bool is_ambiguous() const { return false; }
  // Returns the identity of a local track (the bearing's track_id) that no track explains. A local
  // track that has belonged to a target keeps the target's identity. If the local track becomes a
  // target later, the target takes over the local track's identity. The identity is 0 for a bearing
  // without a local track id, and for the first confirm_s: an ordinary target is initiated within
  // this time. `told`: the identities already published at the same instant; none of them is used
  // twice.
  std::int64_t identify(const BearingMeasurement& newest, std::set<std::int64_t>& told);
  // Whether a track has taken a bearing of this local track within the last within_s.
  bool takes(const BearingMeasurement& newest, std::int64_t now_us, double within_s) const;
  const LocalTracks& followed() const { return identities_.local(); }
  struct Counts {
    std::int64_t initiated = 0, confirmed = 0, deleted = 0, merged = 0, ambiguous = 0, rejected = 0,
                 unexplained = 0;
  };
  const Counts& counts() const { return counts_; }
  // Predicted minus measured direction [rad] (cross-elevation, elevation), for the confirmed track
  // nearest to the bearing. nullopt if there is none in front of the camera.
  std::optional<Eigen::Vector2d> off_nearest(const BearingMeasurement& measurement) const;

 protected:
  TrackManager(const TrackManagerConfig& config, const FilterConfig& filter, bool same_place);
  TrackManager(const TrackManager&) = default;
  TrackManager& operator=(const TrackManager&) = default;

  // Whether a tentative track that has a position meets the criteria.
  virtual bool is_worth_confirming(const Track& track) const = 0;
  virtual void on_confirmed(const Track&) {}
  // Whether a track is lost if fewer than two stations have seen it for unseen_s.
  // is_tentative_lost() judges tentative tracks; is_lost() judges established tracks whose unseen_s
  // exceeds coast_s.
  virtual bool is_tentative_lost(double unseen_s) const = 0;
  virtual bool is_lost(const Track& track, double unseen_s, std::int64_t now_us) const = 0;
  // Called before the deleted tracks are removed.
  virtual void merge_duplicates() {}

  Association give_to(Track& track, const BearingMeasurement& measurement,
                      const Innovation* seen = nullptr);
  Track& begin(Track track);
  void replace(Track& track, Track by);
  // Confirms a tentative track that meets the criteria.
  void consider(Track& track);
  // Called when message time was reset. Forgets everything except the identities in use.
  void clear_tracks();

  TrackManagerConfig config_;
  TrackInitiation initiation_;
  BiasModel errors_;
  std::vector<Track> tracks_;
  std::vector<TrackGlance> glances_;  // for each track
  TrackIdentities identities_;
  Counts counts_;

 private:
  void age(Track& track, std::int64_t now_us);
  bool is_duplicate(const Track& track) const;
  void confirm(Track& track);
  void keep(Track& track, const BearingMeasurement& measurement) const;
  void forget_what_it_taught(const Track& track);
};

}  // namespace ols::fusion
