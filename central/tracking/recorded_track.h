// The track of a recording that contains only one object. Every bearing is offered to this track.
// Pure.
//
//  - Two rays begin the track; it is then on trial. The track is confirmed once it has a position.
//    The trial ends when the bearings also satisfy the rules of track initiation
//    (track_initiation.h). If a bearing is rejected during the trial, the track is deleted, and
//    everything learnt from it is forgotten. For a second after that, two rays alone do not begin a
//    track: the rules of track initiation apply.
//  - A station disagrees with the track if most of its recent bearings are rejected. If at least
//    two stations, and at least half of all stations, disagree, a newly initiated track on which
//    more stations agree replaces the track. The track keeps its identity.
//  - coasting -> deleted: fewer than two stations have seen the track for drop_s. Then two rays can
//    begin a track again.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "central/tracking/track_manager.h"

namespace ols::fusion {

class RecordedTrack : public TrackManager {
 public:
  explicit RecordedTrack(const TrackManagerConfig& config);

  using TrackManager::add;
  std::vector<Association> add(std::span<const BearingMeasurement> image, bool may_begin) override;
  // Whether the track's trial has ended.
  bool is_initiated() const { return proved_; }
  // The confirmed track; null if there is none.
  const Track* located() const;

 private:
  // The recent share of a station's bearings that the track explains.
  struct Explains {
    std::int64_t newest_us = 0;
    double share = 1.0;
  };
  Association add_one(const BearingMeasurement& measurement, bool may_begin);
  void note(const BearingMeasurement& measurement, bool used);
  void take_back(std::int64_t utime_us);
  void confirm_by_initiation(const BearingMeasurement& measurement);
  bool is_better(const Track& start) const;
  int stations(bool explained) const;
  bool most_stations_disagree() const;

  bool is_worth_confirming(const Track&) const override { return true; }
  bool is_tentative_lost(double unseen_s) const override { return unseen_s > config_.drop_s; }
  bool is_lost(const Track& track, double unseen_s, std::int64_t now_us) const override;

  std::map<std::string, Explains> explains_;
  bool proved_ = false;
  BiasModel errors_before_;                    // the station errors before the trial
  std::optional<std::int64_t> taken_back_us_;  // when a trial last failed
};

}  // namespace ols::fusion
