// The camera kind for GigE Vision cameras (camera_kind.h).
#pragma once

#include <memory>
#include <string>

#include "edge/camera/aravis/aravis_config.h"
#include "edge/camera/camera_kind.h"

namespace ols::camera {

class AravisKind : public CameraKind {
 public:
  config::Section section() override { return aravis_section(aravis); }
  const CameraConfig& config() const override { return aravis; }
  std::string address() const override { return aravis.device; }
  std::unique_ptr<Camera> open(bool keep_raw) const override;

  AravisConfig aravis;
};

}  // namespace ols::camera
