// The inputs and outputs of a station: states, commands, bearings. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "conditions/alarm.h"
#include "edge/camera/frame.h"
#include "edge/lens/lens_types.h"
#include "edge/mount/angle_history.h"
#include "edge/sensors/pose_estimator.h"
#include "geometry/sight.h"

namespace ols::station {

// The values are those of station_status_t.
enum class StationState {
  kIdle,
  kManual,
  kTracking,
  kCoasting,
  kLost,
  kSlewed,
  kStopped,
  kEmergency,
  kHidden
};
const char* to_string(StationState state);

// Whether `now` is outside the uncertainty of `stated`, or has another source.
bool differs(const sensors::StationPose& stated, const sensors::StationPose& now);

// What a detector has measured of an object besides its direction. 0 means unknown.
struct DetectedObject {
  bool is_tracklet = true;  // false: it is the target that the tracker follows
  // Number of bearings that the detector makes from this image, including this one.
  int image_bearings = 0;
  Eigen::Vector2d rate_rad_s = Eigen::Vector2d::Zero();       // cross-elevation, elevation
  Eigen::Matrix2d rate_covariance = Eigen::Matrix2d::Zero();  // [rad^2/s^2]
  double size_rad = 0.0, size_sd_rad = 0.0;                   // longer side of its upright box
  double across_rad = 0.0;                                    // shorter side of that box
  // 1-sigma of the random part of size_rad's error, which is independent from image to image; 0 if
  // unknown.
  double size_noise_rad = 0.0;
  double signal = 0.0;  // signal-to-noise ratio
};

// A bearing, before it is converted to a message.
struct Bearing {
  double mid_exposure_s = 0.0;
  LineOfSight sight;
  double belief = 0.0;
  std::int64_t track_id = 0;
  double stamp_sd_s = 0.0;
  camera::StampSource stamp_source = camera::StampSource::kCamera;
  // PointingModel::pose_revision(): 0 at the start; is incremented when the pose changes by more
  // than its sigmas, or when geometry or setup change.
  std::int64_t pose_revision = 0;
  // The values from which the bearing was made:
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Zero();  // white part
  double designation_sd_px = 0.0;  // 1-sigma of the pixel's offset from the target's middle
  // True: the target was found along a slew; false: an operator designated it.
  bool acquired = false;
  std::optional<DetectedObject> detected{};

  bool is_tracklet() const { return detected && detected->is_tracklet; }
};

struct DesignateCommand {
  // Mid-exposure of the frame to which the box refers; nullopt for the newest.
  std::optional<double> frame_time_s;
  cv::Rect2d box;  // [px]; a box without size means the object at that point
};

struct SlewCommand {
  double effect_s = 0.0;  // the instant at which the direction holds
  double received_s = 0.0;
  double lease_s = 0.0;
  std::int64_t sender = 0;  // the boot id of the fusion
  std::int64_t target_id = 0;
  AzimuthElevation direction;  // relative to the horizon at the camera centre
  double azimuth_rate_rad_s = 0.0;
  double elevation_rate_rad_s = 0.0;
  double direction_sd_rad = 0.0;
  // For a search along another station's line of sight: the direction of that line in this
  // station's view (cross-elevation, elevation), a unit vector. The target may then be anywhere on
  // the line, and direction_sd_rad is the 1-sigma across the line.
  Eigen::Vector2d line = Eigen::Vector2d::Zero();
  // If the tracker follows the object with this track_id, it must let go of it. 0 means none.
  std::int64_t let_go_track_id = 0;
  bool searches_line() const { return !line.isZero(); }
  // Whether the slew gives a direction. If not, the station only lets go of its object.
  bool leads() const {
    return let_go_track_id == 0 || target_id != 0 || searches_line() || direction_sd_rad > 0.0;
  }
};
AzimuthElevation direction_at(const SlewCommand& slew, double time_s);

// The fusion's prediction for a target that the land hides: when and where the target will
// reappear.
struct OcclusionCommand {
  double made_s = 0.0;
  double received_s = 0.0;
  double holds_s = 0.0;     // how long the prediction is valid; 0 withdraws the previous prediction
  std::int64_t sender = 0;  // the boot id of the fusion
  std::int64_t target_id = 0;
  struct Exit {
    double time_s = 0.0, sd_s = 0.0;
    AzimuthElevation direction;  // direction of the target at that time, at the camera centre
    double direction_sd_rad = 0.0;
  };
  std::optional<Exit> exit;  // nullopt: the target does not reappear within the predicted time
};

struct PointCommand {
  PanTilt angles;
};

// Turns the unit so that the object at this pixel of a frame comes to the middle of the picture.
struct CentreCommand {
  // Mid-exposure of the frame to which the pixel refers; nullopt for the newest.
  std::optional<double> frame_time_s;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};

struct RateCommand {
  PanTilt rate;  // [rad/s]
  double received_s = 0.0;
  double lease_s = 0.0;
  std::int64_t sender = 0;  // the sender's boot id
  std::int64_t sequence = 0;
};

// Positions or rates for some axes of the lens; the other axes continue as before.
struct LensCommand {
  bool is_rate = false;
  lens::ByAxis<std::optional<double>> values;
  double received_s = 0.0;
  double lease_s = 0.0;
};

// Why a command was refused. to_string() returns the word that the counters have in their names.
enum class Refusal {
  kNone,
  kNotFinite,
  kOutOfRange,       // invalid angle; lease not positive or too long; time too far from the present
  kUnreachable,      // outside the unit's travel
  kNoFrame,          // the station does not have the frame to which the command refers
  kNothingThere,     // designation of a point at which nothing stands out
  kBox,              // designation of a box that is outside the image or too small
  kTracker,          // the tracker refused the image
  kPrecedence,       // slew or prediction while an operator controls the PTU (manual or stopped)
  kEmergency,        // after an emergency stop that has not been re-armed
  kNoReference,      // the unit has no valid reference
  kNoUnit,           // there is no unit to home
  kKeepOut,          // homing would sweep across a keep-out region
  kNoDoubt,          // confirmation of a reference that is not in doubt
  kNoLens,           // there is no motorised lens
  kOverview,         // slew or prediction for an overview station, which a person controls
  kFixedMount,       // command to move a fixed mount
  kOvertaken,        // a later rate, prediction or designation has taken its place
  kStopped,          // rate while the station is stopped, or designation overtaken by a stop
  kJustStopped,      // within kStopHold_s after a stop: the command may have been sent before it
  kRearmNeedsAHand,  // re-arming over the bus, although it needs a person at the station
};
const char* to_string(Refusal refusal);

// A summary of a station for a person.
struct StationSnapshot {
  StationState state = StationState::kIdle;
  bool overview = false;
  bool moves = true;
  lens::ByAxis<std::optional<double>> lens;  // positions of the lens's axes
  std::optional<double> focal_length_px;     // nullopt while the zoom is unknown
  std::optional<CameraIntrinsics> camera;    // the camera at that focal length
  double focal_length_sd_px = 0.0;
  std::int64_t track_id = 0;
  double belief = 0.0;  // while the target is hidden: the belief when it was last seen
  // On the monotonic clock. hidden_until_s is nullopt while it is not known.
  std::optional<double> hidden_since_s, hidden_until_s;
  std::optional<mount::AngleSample> angles;
  std::optional<AzimuthElevation> optical_axis;
  // Computed for zero pan and tilt if there are no angles.
  Eigen::Vector3d camera_ecef = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector2d> target_offset_px;  // from the principal point, in the newest frame
  std::optional<cv::Rect2d> box;                    // in the newest frame
  double frame_latency_s = 0.0;   // smoothed time from mid-exposure to the bearing
  bool motion_disagrees = false;  // the motion in the image contradicts the PTU's angles
  sensors::StationPose pose;
  std::vector<Alarm> alarms;  // conditions that need a person's action
  // Counters only increase. The time in each state is "seconds_<state>".
  std::map<std::string, double> counters;
};

}  // namespace ols::station
