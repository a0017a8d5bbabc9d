// Asks a V4L2 driver which controls its camera has.
#pragma once

#include <string>
#include <vector>

#include "edge/camera/v4l2/v4l2_controls.h"

namespace ols::camera {

// Returns an empty list if the device does not exist or is not a camera.
std::vector<V4l2Control> v4l2_controls_of(const std::string& device);

}  // namespace ols::camera
