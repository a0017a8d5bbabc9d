// What a station needs from its camera.
//
// The camera may be absent, vanish and come back at any time. Then next() returns no frame, and the
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

  // The newest frame, unless it was taken already; waits up to timeout_s for one.
  virtual std::optional<Frame> next(double timeout_s) = 0;
  // Sets the target's box, for automatic exposure; nullopt if there is no target.
  virtual void set_region(const std::optional<cv::Rect2d>& target_box) = 0;
  // Starts one exposure. This has an effect only in trigger mode kSoftware.
  virtual void trigger() = 0;
  // The report's name is "camera" for every kind.
  virtual device::DeviceReport report() const = 0;
};

}  // namespace ols::camera
