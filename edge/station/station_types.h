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

// Whether one pose is outside the uncertainty that the other one states.
bool differs(const sensors::StationPose& stated, const sensors::StationPose& now);

// What a detector says about its object besides the direction. 0 means unknown.
struct DetectedObject {
  bool is_tracklet = true;  // false: of the target, which the tracker follows
  // Number of bearings that the detector makes from this image, including this one.
  int image_bearings = 0;
  Eigen::Vector2d rate_rad_s = Eigen::Vector2d::Zero();       // cross-elevation, elevation
  Eigen::Matrix2d rate_covariance = Eigen::Matrix2d::Zero();  // [rad^2/s^2]
  double size_rad = 0.0, size_sd_rad = 0.0;                   // largest extent
  double across_rad = 0.0;                                    // smaller side of its upright box
  // 1-sigma of the part of the largest extent's error that is independent from image to image; 0 if
  // unknown.
  double size_noise_rad = 0.0;
  double signal = 0.0;  // signal-to-noise ratio
};

// A bearing, before it is turned into a message.
struct Bearing {
  double mid_exposure_s = 0.0;
  LineOfSight sight;
  double belief = 0.0;
  std::int64_t track_id = 0;
  double stamp_sd_s = 0.0;
  camera::StampSource stamp_source = camera::StampSource::kCamera;
  // Incremented when the pose has changed by more than its sigmas; 0 while it is the configured
  // one.
  std::int64_t pose_revision = 0;
  // The values from which the bearing was made:
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Zero();  // white
  double designation_sd_px = 0.0;                            // the same in every frame
  bool acquired = false;  // the target was found along a slew; false: an operator designated it
  std::optional<DetectedObject> detected{};

  bool is_tracklet() const { return detected && detected->is_tracklet; }
};

struct DesignateCommand {
  // Mid-exposure of the frame to which the box refers; nullopt for the newest.
  std::optional<double> frame_time_s;
  cv::Rect2d box;  // [px]; if it has no size, it means the object at that point
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
  // In a search along another station's line of sight: the line's direction here (cross-elevation,
  // elevation), a unit vector. Then the target may be anywhere on the line, and direction_sd_rad is
  // the deviation across the line.
  Eigen::Vector2d line = Eigen::Vector2d::Zero();
  // What the tracker lets go of, if it follows that. 0: nothing.
  std::int64_t let_go_track_id = 0;
  bool searches_line() const { return !line.isZero(); }
  // False: the station only lets go; it is led nowhere.
  bool leads() const {
    return let_go_track_id == 0 || target_id != 0 || searches_line() || direction_sd_rad > 0.0;
  }
};
AzimuthElevation direction_at(const SlewCommand& slew, double time_s);

// The fusion's prediction for a target that the land hides: when and where it comes out.
struct OcclusionCommand {
  double made_s = 0.0;
  double received_s = 0.0;
  double holds_s = 0.0;     // 0: the last prediction no longer holds
  std::int64_t sender = 0;  // the boot id of the fusion
  std::int64_t target_id = 0;
  struct Exit {
    double time_s = 0.0, sd_s = 0.0;
    AzimuthElevation direction;  // at the camera centre
    double direction_sd_rad = 0.0;
  };
  std::optional<Exit> exit;  // empty: the target does not come out within the prediction
};

struct PointCommand {
  PanTilt angles;
};

// Brings the object at this pixel of a frame to the middle of the picture.
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

// Why a command was refused; also the name of its counter.
enum class Refusal {
  kNone,
  kNotFinite,
  kOutOfRange,    // invalid angle; lease not positive or too long; instant too far from the present
  kUnreachable,   // outside the unit's travel
  kNoFrame,       // designation in a frame that the station does not have
  kNothingThere,  // designation of a point at which nothing stands out
  kBox,           // designation of a box that is outside the image or too small
  kTracker,       // the tracker refused the image
  kPrecedence,    // slew while the operator controls the PTU (manual or stopped)
  kEmergency,     // emergency stop that is not yet released and re-armed
  kNoReference,   // the unit has no valid reference
  kNoUnit,        // there is no unit to home
  kKeepOut,       // homing would sweep across a keep-out region
  kNoDoubt,       // the reference is not in doubt, so there is nothing to confirm
  kNoLens,        // there is no motorised lens
  kOverview,      // slew to an overview station, which a person drives
  kFixedMount,    // order to move a mount that never moves
  kOvertaken,     // a later rate from the same sender is already in force
  kStopped,       // rate while the station is stopped; it does not end a stop
  kJustStopped,   // for a moment, a stop overrides commands that were sent before it or crossed it
  kRearmNeedsAHand,  // re-arming over the bus, which needs a person at the station
};
const char* to_string(Refusal refusal);

// A summary of a station for a person.
struct StationSnapshot {
  StationState state = StationState::kIdle;
  bool overview = false;
  bool moves = true;
  lens::ByAxis<std::optional<double>> lens;  // positions of the lens's axes
  std::optional<double> focal_length_px;     // nullopt while the zoom is not known
  std::optional<CameraIntrinsics> camera;    // the camera at that focal length
  double focal_length_sd_px = 0.0;
  std::int64_t track_id = 0;
  double belief = 0.0;  // for a hidden target: its belief when it was last seen
  std::optional<double> hidden_since_s, hidden_until_s;  // monotonic; the latter if it is known
  std::optional<mount::AngleSample> angles;
  std::optional<AzimuthElevation> optical_axis;
  // Computed at zero pan and tilt if there are no angles.
  Eigen::Vector3d camera_ecef = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector2d> target_offset_px;  // from the principal point, in the newest frame
  std::optional<cv::Rect2d> box;                    // in the newest frame
  double frame_latency_s = 0.0;                     // from mid-exposure to the bearing, smoothed
  bool motion_disagrees = false;  // the motion in the image contradicts the PTU's angles
  sensors::StationPose pose;
  std::vector<Alarm> alarms;  // conditions that need a person's action
  // They only increase; times in states are "seconds_<state>"
  std::map<std::string, double> counters;
};

}  // namespace ols::station
