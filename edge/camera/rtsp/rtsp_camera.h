// An RTSP camera, kept connected by its own thread. It controls its exposure itself and has no
// trigger, so set_region() and trigger() do nothing.
#pragma once

#include <memory>
#include <optional>

#include "edge/camera/camera.h"
#include "edge/camera/rtsp/rtsp_config.h"

namespace ols::camera {

class RtspCamera : public Camera {
 public:
  // Starts to connect and returns at once.
  explicit RtspCamera(const RtspConfig& config);
  ~RtspCamera() override;

  std::optional<Frame> next(double timeout_s) override;
  void set_region(const std::optional<cv::Rect2d>& /*target_box*/) override {}
  void trigger() override {}
  device::DeviceReport report() const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::camera
