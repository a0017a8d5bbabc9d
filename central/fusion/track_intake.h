// Associates the bearings of an image with tracks, and reports the station's pointing errors to the
// pointing monitor. The live fusion and the offline fusion both use it. Pure.
#pragma once

#include <span>
#include <vector>

#include "central/admission/pointing_monitor.h"
#include "central/tracking/track_manager.h"

namespace ols::fusion {

struct Associated {
  Association result;
  bool explained = false;    // a track explains the bearing
  bool quarantined = false;  // the station's pose is not credible
  bool newly_so = false;     // the quarantine begins with this bearing
};

// Takes the bearings of one image of a station. Returns their fates in the same order.
std::vector<Associated> associate(std::span<const BearingMeasurement> image, TrackManager& tracks,
                                  PointingMonitor& pointing);

}  // namespace ols::fusion
