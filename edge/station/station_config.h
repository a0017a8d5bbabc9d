// The parameters of a station's decisions. Constant while the station runs.
#pragma once

#include <optional>

#include "edge/detector/detector.h"
#include "edge/lens/zoom_lens.h"
#include "edge/mount/angle_history.h"
#include "edge/mount/limits.h"
#include "edge/station/angular_track.h"
#include "edge/tracker/acquisition.h"
#include "geometry/sight.h"
#include "geometry/station_calibration.h"

namespace ols::station {

struct DetectionConfig {
  bool enabled = true;
  double rate_hz = 10.0;  // maximum rate of images for the detector
  int max_bearings = 16;  // maximum for one image; the likeliest tracklets are sent
  detector::DetectorConfig detector;
};

// Where the station looks while nobody wants its unit.
struct WatchConfig {
  std::optional<AzimuthElevation> middle;  // of the field of regard; empty: the unit stays
  Eigen::Vector2d size_rad = Eigen::Vector2d::Zero();  // of the field: azimuth, elevation
  double stay_s = 3.0;                                 // at each picture
};

struct StationConfig {
  StationGeometry geometry;
  // What an adjustment found; `geometry` then comes from its model.
  std::optional<StationCalibration> calibration;
  bool overview = false;  // driven by a person; the fusion's slews are refused
  std::optional<lens::ZoomLens>
      zoom;  // of a motorised lens; without one, `geometry` has the camera
  mount::AngleHistory::Config angles;
  mount::Limits limits;
  AngularTrack::Config motion;
  double designation_sd_px = 1.0;  // of a designated box's centre on the target
  double tracking_belief = 0.5;    // minimum to be tracking
  double coast_s = 0.7;         // how long the motion model continues after the last believed frame
  int reacquire_frames = 3;     // consecutive believed frames that end a search
  double angle_wait_s = 0.03;   // maximum wait of a frame for the next PTU sample
  double frame_memory_s = 3.0;  // frames are kept this long for a designation: a person's drag
  double search_interval_s = 0.5;  // between two hints of the slew's pixel to a searching tracker
  double search_sd_px = 25.0;      // minimum, around that pixel; at most max_search_sd_px()
  bool acquire_by_slew = true;     // a slewed station without a target acquires one,
  double own_target_s = 5.0;       // and one with a lost target after it has searched for this long
  double unacquired_alarm_s = 10.0;  // slewed this long without a target: an alarm
  double acquisition_sd_px = 3.0;    // of an acquired box's centre on the target
  // Maximum difference between the image motion of two frames and the motion by the PTU's angles.
  double prediction_error_px = 20.0;
  int disagreeing_frames = 5;  // consecutive; raise the alarm
  tracker::AcquisitionConfig acquisition;
  DetectionConfig detection;
  WatchConfig watch;
  bool moves = true;              // false: the mount is fixed
  bool homing_allowed = true;     // on command
  bool rearm_over_bus = false;    // any sender may re-arm; false: only a person at the station
  double slew_lease_max_s = 2.0;  // a longer lease is refused
  double point_time_s = 15.0;     // maximum duration of an operator's move
  double max_age_s = 1.0;         // older frames are not tracked, older bearings not sent
};

// The widest search of the tracker around a slew's pixel.
inline double max_search_sd_px(const StationConfig& config) {
  return config.geometry.camera.width_px / 4.0;
}

}  // namespace ols::station
