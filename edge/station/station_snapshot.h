// Makes the station's summary for status messages, and the frame for viewers. Pure.
#pragma once

#include "edge/camera/frame.h"
#include "edge/frames/pointing_model.h"
#include "edge/station/followed_target.h"
#include "edge/station/station_config.h"
#include "edge/station/station_mode.h"
#include "edge/station/station_types.h"
#include "edge/video/video_frame.h"

namespace ols::station {

struct StationParts {
  const StationConfig& config;
  const StationMode& mode;
  const PointingModel& pointing;
  const FollowedTarget& target;
  bool follows = false;  // the station follows the target in its present mode
  double now_s = 0.0;
};

// Fills everything except the box, the latency, the alarms and the counters.
StationSnapshot snapshot_of(const StationParts& parts);

// A frame for a viewer; its utime is not set.
video::VideoFrame seen_in(const camera::Frame& frame, const StationParts& parts);

// Adds an accepted command to `orders`, which have not been sent to the lens yet.
void add(const LensCommand& command, lens::LensOrder& orders);

}  // namespace ols::station
