// What goes into a station and what comes out: states, commands, bearings. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "edge/camera/frame.h"
#include "edge/ptu/angle_history.h"
#include "edge/sensors/pose_estimator.h"
#include "geometry/sight.h"

namespace ols::station {

enum class StationState {
  kIdle,
  kManual,
  kTracking,
  kCoasting,
  kLost,
  kSlewed,
  kStopped,
  kEmergency
};
const char* to_string(StationState state);

// Whether one pose lies outside of what the other one stated of itself.
bool differs(const sensors::StationPose& stated, const sensors::StationPose& now);

// A bearing before it becomes a message.
struct Bearing {
  double mid_exposure_s = 0.0;
  LineOfSight sight;
  double belief = 0.0;
  std::int64_t track_id = 0;
  double stamp_sd_s = 0.0;
  camera::StampSource stamp_source = camera::StampSource::kCamera;
  // Grows when the pose has changed by more than its sigmas; 0: as configured.
  std::int64_t pose_revision = 0;
};

struct DesignateCommand {
  std::optional<double> frame_time_s;  // mid-exposure of the frame meant; nothing: the newest
  cv::Rect2d box;                      // [px]
};

struct SlewCommand {
  double effect_s = 0.0;  // the instant at which the direction holds
  double received_s = 0.0;
  double lease_s = 0.0;
  std::int64_t sender = 0;  // the boot of the fusion that sent it
  std::int64_t target_id = 0;
  AzimuthElevation direction;  // at the camera centre
  double azimuth_rate_rad_s = 0.0;
  double elevation_rate_rad_s = 0.0;
  double direction_sd_rad = 0.0;
};
AzimuthElevation direction_at(const SlewCommand& slew, double time_s);

struct PointCommand {
  PanTilt angles;
};

// Why a command was refused; also the name of its counter.
enum class Refusal {
  kNone,
  kNotFinite,
  kOutOfRange,   // no such angle, a lease that is not positive or too long, an instant far from now
  kUnreachable,  // outside the unit's travel
  kNoFrame,      // designation without a frame at that time
  kBox,          // designation of a box outside the picture or too small
  kTracker,      // the tracker refused the picture
  kPrecedence,   // a slew while the operator has the PTU (manual or stopped)
  kEmergency,    // after an emergency stop, until it is released and rearmed
  kNoReference,  // what the unit's angles mean is not known
  kNoUnit,       // to home
  kKeepOut,      // homing would sweep across the regions to keep out of
  kNoDoubt,      // about the reference, that a person could end
  kJustStopped,  // a stop holds for a moment, whatever was sent before it or crosses it on the wire
  kRearmNeedsAHand,  // at the station: after an emergency stop nobody frees it from afar
};
const char* to_string(Refusal refusal);

// What a person wants to know of a station at a glance.
struct StationSnapshot {
  StationState state = StationState::kIdle;
  std::int64_t track_id = 0;
  double belief = 0.0;
  std::optional<ptu::AngleSample> angles;
  std::optional<AzimuthElevation> optical_axis;
  Eigen::Vector3d camera_ecef = Eigen::Vector3d::Zero();  // at zero pan and tilt without angles
  std::optional<Eigen::Vector2d> target_offset_px;        // from the principal point, newest frame
  std::optional<cv::Rect2d> box;                          // newest frame
  double frame_latency_s = 0.0;                           // mid-exposure to bearing, smoothed
  bool motion_disagrees = false;  // the picture moves otherwise than the PTU's angles say
  sensors::StationPose pose;
  std::vector<std::string> alarms;         // what a person should do something about
  std::map<std::string, double> counters;  // only go up; state times are "seconds_<state>"
};

}  // namespace ols::station
