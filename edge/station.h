// What a station does, decided without devices, clocks or messages: designate, track, coast, lose,
// be slewed, manual, stopped. Times are the station's monotonic clock [s]. One instance a station,
// called from one thread.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "edge/camera/frame.h"
#include "edge/ptu/angle_history.h"
#include "edge/ptu/servo.h"
#include "edge/tracker/tracker.h"
#include "geometry/sight.h"

namespace ols {

enum class StationState { kIdle, kManual, kTracking, kCoasting, kLost, kSlewed, kStopped };
const char* to_string(StationState state);

struct StationConfig {
  StationGeometry geometry;
  TrackerConfig tracker;
  AngleHistory::Config angles;
  PtuLimits limits;
  std::uint64_t seed = 1;
  double designation_sd_px = 1.0;    // how well a designated box is centred on the target
  double tracking_belief = 0.5;      // at least this to be tracking
  double coast_s = 1.0;              // on the motion model after the last believed frame
  int reacquire_frames = 3;          // believed frames in a row that end a search
  double angle_wait_s = 0.03;        // how long a frame may wait for the PTU sample after it
  double frame_memory_s = 1.0;       // frames kept for a designation in the past
  double command_lease_max_s = 5.0;  // a longer lease is refused
};

// A bearing before it becomes a message.
struct Bearing {
  double mid_exposure_s = 0.0;
  SightLine sight;
  double belief = 0.0;
  std::int64_t track_id = 0;
  double stamp_sd_s = 0.0;
  StampSource stamp_source = StampSource::kCamera;
};

struct DesignateCommand {
  std::optional<double> frame_time_s;  // mid-exposure of the frame meant; nothing: the newest
  cv::Rect2d box;                      // [px]
};

struct SlewCommand {
  double effect_s = 0.0;  // the instant at which the direction holds
  double received_s = 0.0;
  double lease_s = 0.0;
  std::int64_t target_id = 0;
  AzimuthElevation direction;  // at the camera centre
  double azimuth_rate_rad_s = 0.0;
  double elevation_rate_rad_s = 0.0;
  double direction_sd_rad = 0.0;
};

struct PointCommand {
  PanTilt angles;
};

// Why a command was refused; also the name of its counter.
enum class Refusal {
  kNone,
  kNotFinite,
  kOutOfRange,   // not an angle, a box outside the image, a lease that is not positive or too long
  kUnreachable,  // outside the unit's travel
  kNoFrame,      // designation without a frame at that time
  kTracker,      // the tracker refused the box
  kPrecedence,   // a slew while the operator has the PTU (manual or stopped)
};
const char* to_string(Refusal refusal);

}  // namespace ols
