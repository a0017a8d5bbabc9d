// Compares views of the scenery with the pictures stored at the calibration. Finds out whether the
// tripod has turned, an axis has lost steps, or something else has moved. Pure.
#pragma once

#include <cstddef>
#include <vector>

#include "geometry/kinematic_chain.h"
#include "geometry/station_model.h"

namespace ols::station {

// How far the camera's direction has turned in one reference view since the picture was stored.
struct ViewOffset {
  PanTilt shafts;                       // the unit's angles in this view
  double left_rad = 0.0, up_rad = 0.0;  // turn to the left and upwards, on the tangent plane
  double sd_rad = 0.0;                  // 1-sigma of each component
};

enum class DriftCause {
  kNone,       // no change beyond the views' own sigmas
  kTripod,     // all views have turned together, as a rigid body
  kScene,      // one view differs; the others do not
  kLostSteps,  // an axis deviates from its counts by a whole number of motor steps
  kUnclear,    // the views contradict each other
};

struct DriftFinding {
  DriftCause cause = DriftCause::kNone;
  // The turn of the tripod that fits the views best; not valid for kUnclear. For kLostSteps, the
  // heading (pan axis) or the tilt (tilt axis) is at least as large as the angle of the lost steps.
  double heading_rad = 0.0;  // clockwise, like a heading
  double tilt_rad = 0.0;     // tilt of the vertical, in any direction
  double heading_sd_rad = 0.0, tilt_sd_rad = 0.0;
  std::size_t view = 0;  // for kScene: the view that differs
  // For kLostSteps: whether the axis is pan, and the number of steps by which its shaft is ahead of
  // the counts.
  bool pan = false;
  int steps = 0;
};

// The angle by which each shaft turns in one full step of its motor. Lost steps change the angle by
// a multiple of it.
struct MotorSteps {
  double pan_rad = 0.0, tilt_rad = 0.0;
};
MotorSteps motor_steps(const StationModel& model);

// Needs at least three views in different directions; with fewer, the cause is kUnclear.
DriftFinding find_drift(const std::vector<ViewOffset>& views, const MotorSteps& steps);

}  // namespace ols::station
