// Associates the bearings of an image with their tracks, and reports their pointing errors to the
// monitor. Used live and offline. Pure.
#pragma once

#include <span>
#include <vector>

#include "central/admission/pointing_monitor.h"
#include "central/tracking/track_manager.h"

namespace ols::fusion {

struct Associated {
  Association result;
  bool explained = false;    // by a track
  bool quarantined = false;  // the station's pose is not credible
  bool newly_so = false;     // since this bearing
};

// The bearings of one image of a station; their fates in the same order.
std::vector<Associated> associate(std::span<const BearingMeasurement> image, TrackManager& tracks,
                                  PointingMonitor& pointing);

}  // namespace ols::fusion
