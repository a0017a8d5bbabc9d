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

// Whether one pose is outside the stated uncertainty of the other.
bool differs(const sensors::StationPose& stated, const sensors::StationPose& now);

// What a detector says of its object besides the direction. 0: unknown.
struct DetectedObject {
  int image_bearings = 0;  // number of the detector's bearings of this image, including this one
  Eigen::Vector2d rate_rad_s = Eigen::Vector2d::Zero();       // cross-elevation, elevation
  Eigen::Matrix2d rate_covariance = Eigen::Matrix2d::Zero();  // [rad^2/s^2]
  double size_rad = 0.0, size_sd_rad = 0.0;                   // largest extent
  double signal = 0.0;                                        // signal-to-noise ratio
};

// A bearing before it becomes a message.
struct Bearing {
  double mid_exposure_s = 0.0;
  LineOfSight sight;
  double belief = 0.0;
  std::int64_t track_id = 0;
  double stamp_sd_s = 0.0;
  camera::StampSource stamp_source = camera::StampSource::kCamera;
  // Incremented when the pose has changed by more than its sigmas; 0: as configured.
  std::int64_t pose_revision = 0;
  // The values from which it was made.
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Zero();  // white
  double designation_sd_px = 0.0;                            // stays
  std::optional<DetectedObject> detected{};  // of a detector's tracklet; empty: of the target
};

struct DesignateCommand {
  std::optional<double> frame_time_s;  // mid-exposure of the frame meant; empty: the newest
  cv::Rect2d box;                      // [px]; without a size: the object at that point
};

struct SlewCommand {
  double effect_s = 0.0;  // the instant of the direction
  double received_s = 0.0;
  double lease_s = 0.0;
  std::int64_t sender = 0;  // the boot id of the fusion
  std::int64_t target_id = 0;
  AzimuthElevation direction;  // at the camera centre
  double azimuth_rate_rad_s = 0.0;
  double elevation_rate_rad_s = 0.0;
  double direction_sd_rad = 0.0;
  // In a search along another station's line of sight: the line's direction here (cross-elevation,
  // elevation), a unit vector. The target may be anywhere on the line; the deviation is that across
  // the line.
  Eigen::Vector2d line = Eigen::Vector2d::Zero();
  bool searches_line() const { return !line.isZero(); }
};
AzimuthElevation direction_at(const SlewCommand& slew, double time_s);

// The land hides the target: when and where it comes out, as the fusion predicts it.
struct OcclusionCommand {
  double made_s = 0.0;
  double received_s = 0.0;
  double holds_s = 0.0;     // 0: what was said before no longer holds
  std::int64_t sender = 0;  // the boot id of the fusion
  std::int64_t target_id = 0;
  struct Exit {
    double time_s = 0.0, sd_s = 0.0;
    AzimuthElevation direction;  // at the camera centre
    double direction_sd_rad = 0.0;
  };
  std::optional<Exit> exit;  // empty: not within the prediction
};

struct PointCommand {
  PanTilt angles;
};

// Brings what was at this pixel of a frame to the middle of the picture.
struct CentreCommand {
  std::optional<double> frame_time_s;  // mid-exposure of the frame meant; empty: the newest
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};

struct RateCommand {
  PanTilt rate;  // [rad/s]
  double received_s = 0.0;
  double lease_s = 0.0;
  std::int64_t sender = 0;  // boot id
  std::int64_t sequence = 0;
};

// Positions or rates of some axes of the lens; the other axes continue.
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
  kOutOfRange,       // invalid angle, lease not positive or too long, instant too far from now
  kUnreachable,      // outside the unit's travel
  kNoFrame,          // a designation for an instant without a frame
  kNothingThere,     // a designation of a point where nothing stands out
  kBox,              // a designation of a box that is outside the image, or too small
  kTracker,          // the tracker refused the image
  kPrecedence,       // a slew while the operator has the PTU (manual or stopped)
  kEmergency,        // after an emergency stop, until it is released and re-armed
  kNoReference,      // the unit has no valid reference
  kNoUnit,           // no unit to home
  kKeepOut,          // homing would sweep across a keep-out region
  kNoDoubt,          // the reference is not in doubt, so there is nothing to confirm
  kNoLens,           // no motorised lens
  kOverview,         // a slew: an overview station is driven by a person
  kFixedMount,       // an order to move: the mount never moves
  kOvertaken,        // a later rate of the same sender is in force
  kStopped,          // a rate while stopped: it does not end a stop
  kJustStopped,      // a stop overrides, for a moment, commands sent before it or crossing it
  kRearmNeedsAHand,  // after an emergency stop; not over the bus
};
const char* to_string(Refusal refusal);

// A summary of a station for a person.
struct StationSnapshot {
  StationState state = StationState::kIdle;
  bool overview = false;
  bool moves = true;
  lens::ByAxis<std::optional<double>> lens;  // positions of its axes
  std::optional<double> focal_length_px;     // empty while the zoom is not known
  std::optional<CameraIntrinsics> camera;    // at that focal length
  double focal_length_sd_px = 0.0;
  std::int64_t track_id = 0;
  double belief = 0.0;  // of a hidden target: when it was last seen
  std::optional<double> hidden_since_s, hidden_until_s;  // monotonic; until: if it is known
  std::optional<mount::AngleSample> angles;
  std::optional<AzimuthElevation> optical_axis;
  Eigen::Vector3d camera_ecef = Eigen::Vector3d::Zero();  // at zero pan and tilt without angles
  std::optional<Eigen::Vector2d> target_offset_px;        // from the principal point, newest frame
  std::optional<cv::Rect2d> box;                          // newest frame
  double frame_latency_s = 0.0;                           // mid-exposure to bearing, smoothed
  bool motion_disagrees = false;  // the image motion contradicts the PTU's angles
  sensors::StationPose pose;
  std::vector<Alarm> alarms;               // conditions on which a person should act
  std::map<std::string, double> counters;  // only rise; state times are "seconds_<state>"
};

}  // namespace ols::station
