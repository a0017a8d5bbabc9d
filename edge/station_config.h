// What a station's decisions can be configured by. Nothing of it changes while the station runs.
#pragma once

#include "edge/angular_track.h"
#include "edge/ptu/angle_history.h"
#include "edge/ptu/servo.h"
#include "edge/tracker/acquisition.h"
#include "geometry/sight.h"

namespace ols::station {

struct StationConfig {
  StationGeometry geometry;
  ptu::AngleHistory::Config angles;
  ptu::PtuLimits limits;
  AngularTrack::Config motion;
  double designation_sd_px = 1.0;    // how well a designated box is centred on the target
  double tracking_belief = 0.5;      // at least this to be tracking
  double coast_s = 0.7;              // on the motion model after the last believed frame
  int reacquire_frames = 3;          // believed frames in a row that end a search
  double angle_wait_s = 0.03;        // how long a frame may wait for the PTU sample after it
  double frame_memory_s = 1.0;       // frames kept for a designation in the past
  double search_interval_s = 0.5;    // while searching, the tracker is sent to the slew's pixel
  double search_sd_px = 25.0;        // at least, around that pixel; at most max_search_sd_px()
  bool acquire_by_slew = true;       // a slewed station without a target looks for one itself,
  double own_target_s = 5.0;         // one with a target after it has looked for that for so long
  double unacquired_alarm_s = 10.0;  // slewed for so long without a target: an alarm
  double acquisition_sd_px = 3.0;    // how well the box found is centred on the target
  // The picture's own motion between two frames may differ so far from that of the PTU's angles.
  double prediction_error_px = 20.0;
  int disagreeing_frames = 5;  // in a row that raise the alarm
  tracker::AcquisitionConfig acquisition;
  bool homing_allowed = true;     // on command
  bool rearm_over_bus = false;    // by whoever sends it; else by a hand at the station only
  double slew_lease_max_s = 2.0;  // a longer lease is refused
  double point_time_s = 15.0;     // an operator's move may take this long
  double max_age_s = 1.0;         // older frames are not tracked, older bearings not sent
};

// The widest search of the tracker around a slew's pixel.
inline double max_search_sd_px(const StationConfig& config) {
  return config.geometry.camera.width_px / 4.0;
}

}  // namespace ols::station
