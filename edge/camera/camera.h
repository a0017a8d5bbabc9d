// What a station needs of its camera.
//
// The camera may be absent, vanish and come back at any time. next() then has no frame, and the
// report says why. Every method may be called from any thread, and none throws.
#pragma once

#include <optional>

#include "edge/camera/frame.h"
#include "edge/device/device_report.h"

namespace ols::camera {

class Camera {
 public:
  Camera() = default;
  virtual ~Camera() = default;
  Camera(const Camera&) = delete;
  Camera& operator=(const Camera&) = delete;

  // The newest frame that was not taken yet; waits up to timeout_s for a frame.
  virtual std::optional<Frame> next(double timeout_s) = 0;
  // The target's box, for automatic exposure; empty: no target.
  virtual void set_region(const std::optional<cv::Rect2d>& target_box) = 0;
  // Starts one exposure. Has an effect only with the software trigger.
  virtual void trigger() = 0;
  // Named "camera" for every kind.
  virtual device::DeviceReport report() const = 0;
};

}  // namespace ols::camera
