// The camera kind for RTSP cameras (camera_kind.h).
#pragma once

#include <memory>
#include <string>

#include "edge/camera/camera_kind.h"
#include "edge/camera/rtsp/rtsp_config.h"

namespace ols::camera {

class RtspKind : public CameraKind {
 public:
  config::Section section() override { return rtsp_section(rtsp); }
  const CameraConfig& config() const override { return rtsp; }
  std::string address() const override { return shown_url(rtsp.url); }
  std::unique_ptr<Camera> open(bool keep_raw) const override;

  RtspConfig rtsp;
};

}  // namespace ols::camera
