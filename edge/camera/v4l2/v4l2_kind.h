// The camera kind for V4L2 cameras (camera_kind.h).
#pragma once

#include <memory>
#include <string>

#include "edge/camera/camera_kind.h"
#include "edge/camera/v4l2/v4l2_config.h"

namespace ols::camera {

class V4l2Kind : public CameraKind {
 public:
  config::Section section() override { return v4l2_section(v4l2); }
  const CameraConfig& config() const override { return v4l2; }
  std::string address() const override { return v4l2.device; }
  std::unique_ptr<Camera> open(bool keep_raw) const override;

  V4l2Config v4l2;
};

}  // namespace ols::camera
