// A camera that Linux drives. It has no trigger, and its exposure is a control, so set_region() and
// trigger() have no effect.
#pragma once

#include "edge/camera/threaded_camera.h"
#include "edge/camera/v4l2/v4l2_config.h"

namespace ols::camera {

class V4l2Camera : public ThreadedCamera {
 public:
  explicit V4l2Camera(const V4l2Config& config);
};

}  // namespace ols::camera
