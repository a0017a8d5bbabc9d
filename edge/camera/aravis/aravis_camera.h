// A GigE Vision camera, used through Aravis and kept open by its own thread.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "edge/camera/aravis/aravis_config.h"
#include "edge/camera/camera.h"
#include "edge/camera/camera_report.h"
#include "edge/camera/frame.h"

namespace ols::camera {

class AravisCamera : public Camera {
 public:
  // Starts to look for the camera and returns at once.
  explicit AravisCamera(const AravisConfig& config);
  ~AravisCamera() override;

  std::optional<Frame> next(double timeout_s) override;
  void set_region(const std::optional<cv::Rect2d>& target_box) override;
  void trigger() override;
  device::DeviceReport report() const override;

  CameraState state() const;
  CameraCounters counters() const;
  std::string last_error() const;  // the last error as text; empty if there was none

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::camera
