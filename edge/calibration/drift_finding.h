// Compares views of the scenery with the views stored at the calibration, to find whether the
// tripod has turned, an axis has lost steps, or something else has moved. Pure.
#pragma once

#include <cstddef>
#include <vector>

#include "geometry/kinematic_chain.h"
#include "geometry/station_model.h"

namespace ols::station {

// The turn of the camera's direction against the stored picture, in one reference view.
struct ViewOffset {
  PanTilt shafts;                       // of the view
  double left_rad = 0.0, up_rad = 0.0;  // on the tangent plane
  double sd_rad = 0.0;                  // of each component
};

enum class DriftCause {
  kNone,       // nothing beyond the views' own deviations
  kTripod,     // all views turned as one body
  kScene,      // one view differs, the others do not
  kLostSteps,  // an axis is off its counts by a multiple of a motor step
  kUnclear,    // the views agree on nothing
};

struct DriftFinding {
  DriftCause cause = DriftCause::kNone;
  // The turn of the tripod that explains the views best, except for kUnclear. For kLostSteps it is
  // at least as large as the lost steps: heading for the pan axis, tilt for the tilt axis.
  double heading_rad = 0.0;  // clockwise, as a heading
  double tilt_rad = 0.0;     // of the vertical, in any direction
  double heading_sd_rad = 0.0, tilt_sd_rad = 0.0;
  std::size_t view = 0;  // kScene: the view
  bool pan = false;  // kLostSteps: the axis, and how many steps its shaft is ahead of the counts
  int steps = 0;
};

// The unit of lost steps: a full step of the motor, at the shaft.
struct MotorSteps {
  double pan_rad = 0.0, tilt_rad = 0.0;
};
MotorSteps motor_steps(const StationModel& model);

// Needs three or four views in different directions; fewer give kUnclear.
DriftFinding find_drift(const std::vector<ViewOffset>& views, const MotorSteps& steps);

}  // namespace ols::station
