// Asks a V4L2 driver which controls its camera has.
#pragma once

#include <string>
#include <vector>

#include "edge/camera/v4l2/v4l2_controls.h"

namespace ols::camera {

// Empty if there is no such device, or if it is no camera.
std::vector<V4l2Control> v4l2_controls_of(const std::string& device);

}  // namespace ols::camera
