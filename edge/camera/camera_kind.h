// A kind of camera: its keys in the configuration section [camera], and a function that opens it.
#pragma once

#include <memory>
#include <string>

#include "base/config/config_section.h"
#include "edge/camera/camera.h"
#include "edge/camera/camera_config.h"

namespace ols::camera {

class CameraKind {
 public:
  virtual ~CameraKind() = default;
  virtual config::Section section() = 0;  // binds its keys to this object's members
  virtual const CameraConfig& config() const = 0;
  virtual std::string address() const = 0;  // device path, id or URL of the camera, for messages
  // Starts the camera's thread, which connects to the camera, and returns at once. `keep_raw`:
  // frames also contain the raw image, for the recorder and for the colours of the tracker.
  virtual std::unique_ptr<Camera> open(bool keep_raw) const = 0;
};

}  // namespace ols::camera
