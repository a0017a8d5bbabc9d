// A camera that Linux drives, kept open by a thread of its own. It has no trigger, and its exposure
// is a control, so set_region() and trigger() do nothing.
#pragma once

#include <memory>
#include <optional>

#include "edge/camera/camera.h"
#include "edge/camera/v4l2/v4l2_config.h"

namespace ols::camera {

class V4l2Camera : public Camera {
 public:
  // Starts to open it and returns at once.
  explicit V4l2Camera(const V4l2Config& config);
  ~V4l2Camera() override;

  std::optional<Frame> next(double timeout_s) override;
  void set_region(const std::optional<cv::Rect2d>& /*target_box*/) override {}
  void trigger() override {}
  device::DeviceReport report() const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::camera
