// Compares views of the scenery with the pictures stored at the calibration, to find out whether
// the tripod has turned, an axis has lost steps, or something else has moved. Pure.
#pragma once

#include <cstddef>
#include <vector>

#include "geometry/kinematic_chain.h"
#include "geometry/station_model.h"

namespace ols::station {

// How far the camera's direction has turned since the stored picture, in one reference view.
struct ViewOffset {
  PanTilt shafts;                       // the unit's angles in this view
  double left_rad = 0.0, up_rad = 0.0;  // on the tangent plane
  double sd_rad = 0.0;                  // 1-sigma of each component
};

enum class DriftCause {
  kNone,       // no change beyond the views' own deviations
  kTripod,     // all views have turned as one body
  kScene,      // one view differs; the others do not
  kLostSteps,  // an axis deviates from its counts by a multiple of a motor step
  kUnclear,    // the views contradict each other
};

struct DriftFinding {
  DriftCause cause = DriftCause::kNone;
  // The turn of the tripod that best explains the views; not valid for kUnclear. For kLostSteps,
  // the heading (pan axis) or the tilt (tilt axis) is at least as large as the lost steps.
  double heading_rad = 0.0;  // clockwise, like a heading
  double tilt_rad = 0.0;     // tilt of the vertical, in any direction
  double heading_sd_rad = 0.0, tilt_sd_rad = 0.0;
  std::size_t view = 0;  // for kScene: the view that differs
  // For kLostSteps: the axis, and the number of steps by which its shaft is ahead of the counts.
  bool pan = false;
  int steps = 0;
};

// The unit of lost steps: the angle of the shaft for one full step of the motor.
struct MotorSteps {
  double pan_rad = 0.0, tilt_rad = 0.0;
};
MotorSteps motor_steps(const StationModel& model);

// Needs at least three views in different directions; with fewer, the cause is kUnclear.
DriftFinding find_drift(const std::vector<ViewOffset>& views, const MotorSteps& steps);

}  // namespace ols::station
