// A kind of camera: its keys in [camera], and the way to open it.
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
  virtual config::Section section() = 0;  // the section refers to this object
  virtual const CameraConfig& config() const = 0;
  virtual std::string address() const = 0;  // in words: the camera for which it looks
  // Starts to look for the camera and returns at once. `keep_raw`: the camera also keeps its raw
  // images, for a recorder and for the tracker's colours.
  virtual std::unique_ptr<Camera> open(bool keep_raw) const = 0;
};

}  // namespace ols::camera
