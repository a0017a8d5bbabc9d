// The controls of a V4L2 camera: exposure, gain, focus. Pure.
//
// GStreamer sets the controls that the configuration names. It silently ignores a control that the
// camera does not have. The names are therefore compared with the camera's controls first.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "edge/camera/camera_errors.h"

namespace ols::camera {

struct V4l2Control {
  std::string name;  // as in the configuration: "exposure_time_absolute"
  long long least = 0, greatest = 0;
};

// Converts a driver's name of a control, "Exposure Time, Absolute", to the name in v4l2-ctl and
// GStreamer, "exposure_time_absolute".
std::string v4l2_control_name(std::string_view of_driver);

// Throws CameraUnfit for the first control in `configured` that the camera does not have, or whose
// value is out of the camera's range. `configured`: "gain=3,focus_auto=0".
void check_v4l2_controls(const std::string& configured, const std::vector<V4l2Control>& camera);

}  // namespace ols::camera
