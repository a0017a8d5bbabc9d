// Live tracks of several targets, and the association of bearings with them. Pure.
//
// The rules (details in docs/fusion.md):
//  - The bearings of one image are assigned to the confirmed tracks so that the sum of the NIS is
//    smallest. The remaining bearings are assigned to the tentative tracks in the same way. A track
//    takes at most one bearing per exposure of a station.
//  - If two confirmed tracks fit a bearing about equally well (they cross in that station's view),
//    the bearing is ambiguous and updates neither track. The bearings of other stations, which see
//    the two tracks apart, go on updating both.
//  - Unassociated bearings are kept for track initiation (track_initiation.h).
//  - tentative -> confirmed: three conditions hold. The track has a position. It has rejected at
//    most as many bearings as it has used. It has used two bearings of each of three stations; or
//    it has used five bearings of each of two stations, and is at least confirm_s old.
//  - A track made of tracklets is not confirmed while it may be a ghost. Images from detectors show
//    whether it exists (existence.h). If only two stations see the track, there are two more
//    reasons to suspect a ghost: their tracklets can be paired in several ways, or may agree by
//    chance (clutter.h). A tracklet belongs to one target only.
//  - tentative -> deleted: fewer than two stations have seen the track for tentative_delete_s, or
//    it is a duplicate of a confirmed track.
//  - coasting -> deleted: fewer than two stations have seen the track for drop_s. The limit is
//    coast_s instead if a station has too many consecutive rejections, unless bearings of at least
//    two other stations have been used since that station's last used bearing.
//  - two confirmed tracks -> one: they have been duplicates for a second (duplicate_tracks.h).
//  - A new track that is confirmed at the predicted position of a deleted one takes over the
//    deleted one's identity. Otherwise it takes over the identity of a bearing-only track of one of
//    its stations, if there is one.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "central/ground/seen_skylines.h"
#include "central/tracking/clutter.h"
#include "central/tracking/duplicate_tracks.h"
#include "central/tracking/loss_watch.h"
#include "central/tracking/track_manager.h"

namespace ols::fusion {

class LiveTracks : public TrackManager {
 public:
  using Merged = std::vector<std::pair<std::int64_t, std::int64_t>>;

  explicit LiveTracks(const TrackManagerConfig& config);

  using TrackManager::add;
  std::vector<Association> add(std::span<const BearingMeasurement> image, bool may_begin) override;
  // Notes where a station's camera looks; view_rad: the narrower field of view. A target that
  // should be in a detector's image but is not becomes less likely to exist; this needs the
  // camera's direction.
  void know_view(const std::string& station, const AzimuthElevation& axis, double view_rad,
                 std::int64_t utime_us) {
    views_.know(station, axis, view_rad, utime_us);
  }
  // Takes a part of the skyline that a station has seen. Its obstacles hide targets, in addition to
  // the model of the land. With a new skyline, past losses are forgotten.
  void know_skyline(const SkylineSector& sector) {
    if (skylines_.take(sector)) losses_.forget(sector.station);
  }
  // Forgets what hides targets from the station, beyond the model of the land.
  void forget_obstacles(const std::string& station) {
    skylines_.forget(station);
    losses_.forget(station);
  }
  void forget_losses(const std::string& station) { losses_.forget(station); }
  const SeenSkylines& skylines() const { return skylines_; }
  // Where stations lose targets that neither the land nor the seen skylines hide. Empty if no model
  // of the land is known.
  const LossWatch& losses() const { return losses_; }
  bool is_ambiguous() const override;
  // The expected number of ghosts per day from two stations alone, with the present clutter.
  double predicted_ghosts_a_day() const {
    return clutter_.published_a_day(config_.confirm_s, most_of_a_pair());
  }
  // Called when message time was reset. Forgets everything except the identities in use: these are
  // never assigned again.
  void clear();
  // The duplicates merged since the last call, in the order of merging; at most the newest 64. Each
  // is a pair of identities: first the one that remains, then the one that ended.
  Merged take_merged() { return std::exchange(merged_, {}); }

 private:
  struct Candidate {
    std::size_t track = 0;
    Innovation seen;
  };
  std::vector<Candidate> candidates(const BearingMeasurement& measurement, bool confirmed) const;
  // Assigns the bearings without a fate to the confirmed tracks, or to the tentative ones.
  void give(std::span<const BearingMeasurement> image, bool confirmed,
            std::vector<std::optional<Association>>& fates);
  // The NIS of each bearing with each of these tracks; infinite if the track cannot take it.
  Eigen::MatrixXd costs(std::span<const BearingMeasurement> image,
                        std::span<const std::vector<Candidate>> near,
                        std::span<const std::size_t> columns);
  Association give_up(const BearingMeasurement& measurement, bool may_begin);
  void judge_existence(std::span<const BearingMeasurement> image);
  bool should_show(const BearingMeasurement& in_image, const Track& track) const;
  double visible(const BearingMeasurement& in_image, const Track& track) const;
  // The probability that neither the land nor the seen skyline hides a position from a station.
  double clear_of_land(const std::string& station, const Eigen::Vector3d& camera_ecef,
                       const Eigen::Vector3d& p_ecef, const Eigen::Matrix3d& P) const;
  void note_losses(std::span<const BearingMeasurement> image,
                   std::span<const Association> associations);
  bool has_rival(const Track& track) const;
  void note_clutter(std::span<const BearingMeasurement> image,
                    std::span<const std::optional<Association>> of_targets,
                    std::span<const std::optional<Association>> of_any);
  bool may_agree_by_chance(const Track& track) const;
  double most_of_a_pair() const {
    return config_.chance_pairs_a_day / clutter_.pairs_of_stations();
  }
  void note_duplicates(const BearingMeasurement& measurement, const std::vector<Candidate>& near);
  Association initiate(const BearingMeasurement& measurement);
  void merge(std::int64_t older, std::int64_t younger);

  bool is_worth_confirming(const Track& track) const override;
  void on_confirmed(const Track& track) override { initiation_.give(track, errors_); }
  bool is_tentative_lost(double unseen_s) const override;
  bool is_lost(const Track& track, double unseen_s, std::int64_t now_us) const override;
  void merge_duplicates() override;

  DuplicateTracks duplicates_;
  StationViews views_;
  SeenSkylines skylines_;
  LossWatch losses_;
  Clutter clutter_;
  Merged merged_;
};

}  // namespace ols::fusion
