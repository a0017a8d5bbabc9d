// An RTSP camera. It controls its own exposure and has no trigger; set_region() and trigger()
// therefore have no effect.
#pragma once

#include "edge/camera/rtsp/rtsp_config.h"
#include "edge/camera/threaded_camera.h"

namespace ols::camera {

class RtspCamera : public ThreadedCamera {
 public:
  explicit RtspCamera(const RtspConfig& config);
};

}  // namespace ols::camera
