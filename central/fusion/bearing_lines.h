// Bearing-only tracks: lines of sight to objects that a station follows and no target explains. A
// tracklet is not a bearing-only track, because nobody has designated its object. But if objects of
// unknown class lead stations (handover_policy.h), the lines of tracklets are included. Pure.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "central/admission/pointing_monitor.h"
#include "central/estimators/alignment.h"
#include "central/fusion/fused_target.h"
#include "central/tracking/track_manager.h"

namespace ols::fusion {

// Keeps references to the tracks and the monitor. Use it only before they change.
class BearingLines {
 public:
  BearingLines(const TrackManager& tracks, const PointingMonitor& pointing,
               const AlignmentConfig& config, bool with_tracklets = false)
      : tracks_(tracks), pointing_(pointing), config_(config), with_tracklets_(with_tracklets) {}

  // Stations that have recently sent an unassociated bearing and are not quarantined.
  std::vector<std::string> stations(std::int64_t epoch_us) const;
  // The newest bearing of each local track of the station, except of tracks that belong to a
  // target. The bearings are sorted by track id: most trackers assign ids in ascending order, and
  // the oldest tracks then come first. Without tracklets, only the first four are returned.
  std::vector<const BearingMeasurement*> of(const std::string& station,
                                            std::int64_t epoch_us) const;
  // The newest bearing of one of the stations that stations() returns.
  const BearingMeasurement* newest_of(const std::string& station) const;
  // Whether a target has recently used a bearing of the same local track.
  bool is_taken(const BearingMeasurement& of, std::int64_t epoch_us) const;
  std::optional<BearingOnly> at(const BearingMeasurement& newest, std::int64_t epoch_us) const;

 private:
  std::ptrdiff_t newest_look(const UnassociatedBearings::Station& own) const;
  const UnassociatedBearings::Station& bearings_of(const std::string& station) const;

  const TrackManager& tracks_;
  const PointingMonitor& pointing_;
  const AlignmentConfig& config_;
  bool with_tracklets_;
};

}  // namespace ols::fusion
