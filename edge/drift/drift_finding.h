// Compares views of the same scenery with those stored at the calibration: whether the tripod has
// turned since, an axis has lost steps, or something else has moved. Pure.
#pragma once

#include <cstddef>
#include <vector>

#include "geometry/kinematic_chain.h"
#include "geometry/station_model.h"

namespace ols::station {

// One reference view: by how much the camera's direction has turned against the stored picture.
struct ViewOffset {
  PanTilt shafts;                       // of the view
  double left_rad = 0.0, up_rad = 0.0;  // on the tangent plane
  double sd_rad = 0.0;                  // of each of the two
};

enum class DriftCause {
  kNone,       // nothing beyond the views' own deviations
  kTripod,     // all views turned as one
  kScene,      // one view differs, the others do not
  kLostSteps,  // an axis counts multiples of a motor's step beside where it stands
  kUnclear,    // the views agree on nothing
};

struct DriftFinding {
  DriftCause cause = DriftCause::kNone;
  // The tripod's turn that explains the views best, in each case but kUnclear. Of kLostSteps at
  // least what they amount to: heading for the pan, tilt for the tilt.
  double heading_rad = 0.0;  // clockwise, as a heading
  double tilt_rad = 0.0;     // of the vertical, whatever its direction
  double heading_sd_rad = 0.0, tilt_sd_rad = 0.0;
  std::size_t view = 0;  // kScene: which one
  bool pan = false;  // kLostSteps: the axis, and how many steps its shaft is ahead of the counts
  int steps = 0;
};

// What an axis loses at once: a full step of its motor, at the shaft.
struct MotorSteps {
  double pan_rad = 0.0, tilt_rad = 0.0;
};
MotorSteps motor_steps(const StationModel& model);

// Three views or four, in different directions: fewer give kUnclear.
DriftFinding find_drift(const std::vector<ViewOffset>& views, const MotorSteps& steps);

}  // namespace ols::station
