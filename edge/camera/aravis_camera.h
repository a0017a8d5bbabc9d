// A GigE Vision camera through Aravis, kept open by its own thread. After construction nothing
// throws.
#pragma once

#include <memory>

#include "edge/camera/camera.h"

namespace ols::camera {

class AravisCamera : public Camera {
 public:
  // Starts to look for the camera and returns at once.
  explicit AravisCamera(const CameraConfig& config);
  ~AravisCamera() override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::camera
