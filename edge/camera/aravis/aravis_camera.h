// A GigE Vision camera, driven through the library Aravis.
#pragma once

#include "edge/camera/aravis/aravis_config.h"
#include "edge/camera/threaded_camera.h"

namespace ols::camera {

class AravisCamera : public ThreadedCamera {
 public:
  explicit AravisCamera(const AravisConfig& config);
};

}  // namespace ols::camera
