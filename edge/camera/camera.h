// The interface of all kinds of cameras.
//
// The camera may be absent at the start, disappear and return at any time. While it is absent,
// next() returns no frame, and report() states the reason. Every method may be called from any
// thread, and none throws.
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

  // Returns the newest frame, each frame only once. If there is no new one, waits up to timeout_s
  // for it, and then returns nullopt.
  virtual std::optional<Frame> next(double timeout_s) = 0;
  // Sets the target's box, for automatic exposure; nullopt if there is no target.
  virtual void set_region(const std::optional<cv::Rect2d>& target_box) = 0;
  // Starts one exposure. Has an effect only with TriggerMode::kSoftware.
  virtual void trigger() = 0;
  // The `name` in the report is "camera" for every kind of camera.
  virtual device::DeviceReport report() const = 0;
};

}  // namespace ols::camera
