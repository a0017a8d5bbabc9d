// Which objects there are: the life cycle of tracks (docs/fusion.md, "The life of a track"), which
// live tracks (live_tracks.h) and the one track of a recording (recorded_track.h) share. Pure.
//
//  - born -> confirmed: it is worth it, and no duplicate of a confirmed one.
//  - confirmed -> coasted: no two stations have seen it for coast_s. coasted -> confirmed: two
//  have.
//  - any -> dropped: two stations alone that are an inconsistent pair: their rays meet only by more
//  than they state.
// When a track is worth confirming, and when it is lost, each says for itself.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
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
  int max_tracks = 256;  // born ones included
  int confirm_stations = 3;
  int confirm_hits = 2;       // of each of them
  int confirm_pair_hits = 5;  // of each of two, where only two see it
  double confirm_s = 0.7;
  double tentative_delete_s = 0.4;
  double coast_s = 0.5;
  double drop_s = Activity::kSupportsS;
  double remember_s = 5.0;     // the identity of a dropped one
  double ambiguous_nis = 9.0;  // difference of two tracks' normalised residuals
  double memory_s = 1.0;       // bearings kept for the estimators without memory
  InitiationConfig birth{};
  FilterConfig filter{};
  BiasModelConfig errors{};
  DuplicatesConfig rivals{};
};

// What became of a bearing.
struct Association {
  enum class Kind { kTrack, kAmbiguous, kUnexplained, kRejected };
  Kind kind = Kind::kUnexplained;
  std::int64_t track_id = 0;  // 0: none, or one that is not confirmed yet
};

class TrackManager {
 public:
  virtual ~TrackManager() = default;

  // may_begin: whether it may take part in the initiation of a track.
  virtual Association add(const BearingMeasurement& sighting, bool may_begin) = 0;
  Association add(const BearingMeasurement& sighting) { return add(sighting, true); }
  // Lives and deaths, by the fusion's time.
  void advance(std::int64_t now_us);
  void forget_station(const std::string& station);
  // What is known of its errors: it has another calibration.
  void forget_errors(const std::string& station) { errors_.forget(station); }
  // Which object it follows: its ids mean something else from now on.
  void forget_followed(const std::string& station) { identities_.forget(station); }

  const std::vector<Track>& tracks() const { return tracks_; }
  const BiasModel& errors() const { return errors_; }
  // What was learnt in another run.
  void set_errors(const BiasModel& errors) { errors_ = errors; }
  const UnassociatedBearings& unassociated() const { return initiation_.pool(); }
  // Why the last bearing began no track, and why there is none at this instant.
  Solution why_no_track_began() const { return initiation_.why_no_track(); }
  Solution why_none(std::int64_t now_us) const { return initiation_.why_none(now_us); }
  // The identity of what a station follows by its own word (the bearing's track_id) and no track
  // explains: it is the target's that it was, and becomes that of the target which it turns out to
  // be. 0 for the first confirm_s, while ordinary targets are found, and for what it does not name.
  // `told`: those of others at the same instant; one id is one object.
  std::int64_t identify(const BearingMeasurement& newest, std::set<std::int64_t>& told);
  // Whether a track takes what the station follows by this name: the last bearing not longer ago.
  bool takes(const BearingMeasurement& newest, std::int64_t now_us, double within_s) const;
  const LocalTracks& followed() const { return identities_.local(); }
  struct Counts {
    std::int64_t born = 0, confirmed = 0, dropped = 0, merged = 0, ambiguous = 0, set_aside = 0,
                 unexplained = 0;
  };
  const Counts& counts() const { return counts_; }
  // Predicted minus measured (cross-elevation, elevation) of the confirmed track that a station's
  // bearing would have to be moved least for.
  std::optional<Eigen::Vector2d> off_nearest(const BearingMeasurement& sighting) const;

 protected:
  TrackManager(const TrackManagerConfig& config, const FilterConfig& filter, bool same_place);
  TrackManager(const TrackManager&) = default;
  TrackManager& operator=(const TrackManager&) = default;

  // Of a born track whose position is one.
  virtual bool is_worth_confirming(const Track& track) const = 0;
  virtual void on_confirmed(const Track&) {}
  // Of a born one that no two stations have seen for unseen_s; of an older one likewise, for longer
  // than coast_s.
  virtual bool is_lost_when_born(double unseen_s) const = 0;
  virtual bool is_lost(const Track& track, double unseen_s, std::int64_t now_us) const = 0;
  // Before what is dropped is taken out.
  virtual void merge_duplicates() {}

  Association give_to(Track& track, const BearingMeasurement& sighting,
                      const Innovation* seen = nullptr);
  Track& begin(Track track);
  void replace(Track& track, Track by);
  // Confirms a born track that is worth it.
  void consider(Track& track);
  // All that belongs to another time line; identities go on.
  void clear_tracks();

  TrackManagerConfig config_;
  TrackInitiation initiation_;
  BiasModel errors_;
  std::vector<Track> tracks_;
  std::vector<TrackGlance> glances_;  // of each track
  TrackIdentities identities_;
  Counts counts_;

 private:
  void age(Track& track, std::int64_t now_us);
  bool is_duplicate(const Track& track) const;
  void confirm(Track& track);
  void keep(Track& track, const BearingMeasurement& sighting) const;
  void forget_what_it_taught(const Track& track);
};

}  // namespace ols::fusion
