// Bearing-only tracks: lines of sight to objects that a station follows and no target explains. A
// tracklet is not a bearing-only track, because nobody has designated its object. But if the site's
// hand-over is automatic, stations are also led along the lines of tracklets. Pure.
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

// A short-lived view of the tracks and monitors that it was made from.
class BearingLines {
 public:
  BearingLines(const TrackManager& tracks, const PointingMonitor& pointing,
               const AlignmentConfig& config, bool with_tracklets = false)
      : tracks_(tracks), pointing_(pointing), config_(config), with_tracklets_(with_tracklets) {}

  // Stations that have recently sent an unassociated bearing and are not quarantined.
  std::vector<std::string> stations(std::int64_t epoch_us) const;
  // The newest bearing of each of the station's tracks that no target takes, sorted by track id
  // (most trackers assign ids in ascending order). Returns only the first four, unless tracklets
  // are included.
  std::vector<const BearingMeasurement*> of(const std::string& station,
                                            std::int64_t epoch_us) const;
  // The newest bearing of a station that stations() has returned.
  const BearingMeasurement* newest_of(const std::string& station) const;
  // Whether a target has recently used a bearing of the same object.
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
