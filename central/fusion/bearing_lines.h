// The lines of sight of stations that follow what no track explains. Pure.
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

// A look at what there is now: short-lived.
class BearingLines {
 public:
  BearingLines(const TrackManager& tracks, const PointingMonitor& pointing,
               const AlignmentConfig& config)
      : tracks_(tracks), pointing_(pointing), config_(config) {}

  // Stations that have lately sent what no track explains.
  std::vector<std::string> stations(std::int64_t epoch_us) const;
  // What a station follows by a name of its own and no track takes: the newest bearing of each, the
  // smallest names first, which most trackers gave first.
  std::vector<const BearingMeasurement*> of(const std::string& station,
                                            std::int64_t epoch_us) const;
  // The newest bearing of a station.
  const BearingMeasurement* newest_of(const std::string& station) const;
  std::optional<BearingOnly> at(const BearingMeasurement& newest, std::int64_t epoch_us) const;

 private:
  const UnassociatedBearings::Station& bearings_of(const std::string& station) const;

  const TrackManager& tracks_;
  const PointingMonitor& pointing_;
  const AlignmentConfig& config_;
};

}  // namespace ols::fusion
