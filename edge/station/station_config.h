// The parameters of a station's decisions. They are constant while the station runs.
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
  double rate_hz = 10.0;  // maximum rate of images passed to the detector
  int max_bearings = 16;  // maximum number for one image; the likeliest objects are chosen
  detector::DetectorConfig detector;
};

// Where the station looks while nothing else uses its unit.
struct WatchConfig {
  // Centre of the field of regard; nullopt means that the unit stays where it is.
  std::optional<AzimuthElevation> middle;
  Eigen::Vector2d size_rad = Eigen::Vector2d::Zero();  // size of the field: azimuth, elevation
  double stay_s = 3.0;                                 // time at each picture
};

struct StationConfig {
  StationGeometry geometry;
  // The station's calibration. If it is set, `geometry` must come from it.
  std::optional<StationCalibration> calibration;
  bool overview = false;  // a person controls the station; the fusion's slews are refused
  std::optional<lens::ZoomLens>
      zoom;  // for a motorised lens; otherwise `geometry` contains the camera
  mount::AngleHistory::Config angles;
  mount::Limits limits;
  AngularTrack::Config motion;
  // 1-sigma of the offset of a designated box's centre from the target's middle.
  double designation_sd_px = 1.0;
  double tracking_belief = 0.5;  // minimum belief at which the target counts as seen
  double coast_s = 0.7;        // how long the motion model continues after the last believed frame
  int reacquire_frames = 3;    // number of consecutive believed frames that end a search
  double angle_wait_s = 0.03;  // maximum time that a frame waits for the next PTU sample
  // How long frames are kept for a designation; a person needs time to drag a box.
  double frame_memory_s = 3.0;
  // While the tracker searches, it gets the pixel to which the slew points at this interval.
  double search_interval_s = 0.5;
  double search_sd_px = 25.0;   // minimum 1-sigma of that pixel; the maximum is max_search_sd_px()
  bool acquire_by_slew = true;  // a station without a target acquires one along a slew
  // A station that has lost its target may acquire another after this time.
  double own_target_s = 5.0;
  // An alarm is raised if a slewed station has acquired no target after this time.
  double unacquired_alarm_s = 10.0;
  // 1-sigma of the offset of an acquired box's centre from the target's middle.
  double acquisition_sd_px = 3.0;
  // Maximum difference, at the target, between the motion that two images show and the motion
  // according to the PTU's angles.
  double prediction_error_px = 20.0;
  // The alarm is raised if this many consecutive frames have a larger difference.
  int disagreeing_frames = 5;
  tracker::AcquisitionConfig acquisition;
  DetectionConfig detection;
  WatchConfig watch;
  bool moves = true;            // false if the mount is fixed
  bool homing_allowed = true;   // the unit may be homed on command
  bool rearm_over_bus = false;  // true: any sender may re-arm; false: only a person at the station
  double slew_lease_max_s = 2.0;  // slews with a longer lease are refused
  double point_time_s = 15.0;     // maximum duration of a move to an operator's direction
  double max_age_s = 1.0;         // older frames are not tracked, and older bearings are not sent
};

// The maximum 1-sigma with which the tracker searches around the pixel of a slew.
inline double max_search_sd_px(const StationConfig& config) {
  return config.geometry.camera.width_px / 4.0;
}

}  // namespace ols::station
