// Associates a bearing with its track, and reports its pointing error to the monitor. Live and
// offline share it. Pure.
#pragma once

#include <string>

#include "central/admission/pointing_monitor.h"
#include "central/tracking/track_manager.h"

namespace ols::fusion {

struct Associated {
  Association result;
  bool explained = false;    // by a track
  bool quarantined = false;  // the station's pose is not credible
  bool newly_so = false;     // since this bearing
};

Associated associate(const BearingMeasurement& measurement, TrackManager& tracks,
                     PointingMonitor& pointing);

}  // namespace ols::fusion
