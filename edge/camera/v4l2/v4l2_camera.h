// A camera with a Linux driver (Video4Linux2). set_region() has no effect, because the exposure is
// set by a control of the driver (v4l2_controls.h). trigger() has no effect, because such a camera
// has no trigger.
#pragma once

#include "edge/camera/threaded_camera.h"
#include "edge/camera/v4l2/v4l2_config.h"

namespace ols::camera {

class V4l2Camera : public ThreadedCamera {
 public:
  explicit V4l2Camera(const V4l2Config& config);
};

}  // namespace ols::camera
