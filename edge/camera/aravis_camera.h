// A GigE Vision camera through Aravis, kept open by its own thread.
//
// The camera may be absent, vanish and come back at any time. next() then has no frame, and
// state(), counters() and last_error() say why. After construction nothing throws.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "edge/camera/camera_config.h"
#include "edge/camera/camera_report.h"
#include "edge/camera/frame.h"

namespace ols::camera {

class AravisCamera {
 public:
  // Starts to look for the camera and returns at once.
  explicit AravisCamera(const CameraConfig& config);
  ~AravisCamera();
  AravisCamera(const AravisCamera&) = delete;
  AravisCamera& operator=(const AravisCamera&) = delete;

  // The newest frame that was not taken yet; waits up to timeout_s for one.
  std::optional<Frame> next(double timeout_s);

  // The target's box, for automatic exposure; empty: no target.
  void set_region(const std::optional<cv::Rect2d>& target_box);
  // One exposure, with the software trigger; without it a call has no effect.
  void trigger();

  device::DeviceReport report() const;
  CameraState state() const;
  CameraCounters counters() const;
  std::string last_error() const;  // the last error as text; empty: none yet

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::camera
