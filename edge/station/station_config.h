// The parameters for a station's decisions. They are constant while the station runs.
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
  double rate_hz = 10.0;  // maximum rate of images given to the detector
  int max_bearings = 16;  // largest number for one image; the likeliest tracklets are sent
  detector::DetectorConfig detector;
};

// Where the station looks while nobody else uses its unit.
struct WatchConfig {
  // Centre of the field of regard; if nullopt, the unit stays where it is.
  std::optional<AzimuthElevation> middle;
  Eigen::Vector2d size_rad = Eigen::Vector2d::Zero();  // size of the field: azimuth, elevation
  double stay_s = 3.0;                                 // time at each picture
};

struct StationConfig {
  StationGeometry geometry;
  // The result of an adjustment; if set, `geometry` is that of its model.
  std::optional<StationCalibration> calibration;
  bool overview = false;  // the station is driven by a person; slews of the fusion are refused
  std::optional<lens::ZoomLens>
      zoom;  // for a motorised lens; otherwise the camera is that of `geometry`
  mount::AngleHistory::Config angles;
  mount::Limits limits;
  AngularTrack::Config motion;
  double designation_sd_px = 1.0;  // 1-sigma of a designated box's centre on the target
  double tracking_belief = 0.5;    // least belief with which the station is tracking
  double coast_s = 0.7;        // how long the motion model continues after the last believed frame
  int reacquire_frames = 3;    // number of consecutive believed frames that ends a search
  double angle_wait_s = 0.03;  // longest time for which a frame waits for the next PTU sample
  // How long frames are kept for a designation; a person needs time to drag a box.
  double frame_memory_s = 3.0;
  double search_interval_s = 0.5;  // interval at which a searching tracker gets the slew's pixel
  double search_sd_px = 25.0;  // least 1-sigma around that pixel; the largest is max_search_sd_px()
  bool acquire_by_slew = true;  // a slewed station without a target acquires one
  double own_target_s = 5.0;  // a station that has lost its target acquires another after this time
  // An alarm is raised after this time of slewing without a target.
  double unacquired_alarm_s = 10.0;
  double acquisition_sd_px = 3.0;  // 1-sigma of an acquired box's centre on the target
  // Largest difference between the motion in two images and the motion according to the PTU's
  // angles.
  double prediction_error_px = 20.0;
  // This many consecutive frames with a larger difference raise the alarm.
  int disagreeing_frames = 5;
  tracker::AcquisitionConfig acquisition;
  DetectionConfig detection;
  WatchConfig watch;
  bool moves = true;            // false if the mount is fixed
  bool homing_allowed = true;   // homing is allowed on command
  bool rearm_over_bus = false;  // true: any sender may re-arm; false: only a person at the station
  double slew_lease_max_s = 2.0;  // slews with a longer lease are refused
  double point_time_s = 15.0;     // longest duration of an operator's move
  double max_age_s = 1.0;         // older frames are not tracked, and older bearings are not sent
};

// The largest 1-sigma with which the tracker searches around a slew's pixel.
inline double max_search_sd_px(const StationConfig& config) {
  return config.geometry.camera.width_px / 4.0;
}

}  // namespace ols::station
