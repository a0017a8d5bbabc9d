// The camera as the control loop has it, whoever takes its frames: AravisCamera from the wire. It
// may be absent, vanish and come back at any time: then there is no frame, and the report says why.
#pragma once

#include <optional>
#include <string>

#include "edge/camera/camera_config.h"
#include "edge/camera/camera_handover.h"

namespace ols::camera {

class Camera {
 public:
  explicit Camera(const CameraConfig& config) : config_(config) {}
  virtual ~Camera() = default;
  Camera(const Camera&) = delete;
  Camera& operator=(const Camera&) = delete;

  // The newest frame that was not taken yet; waits up to timeout_s for one.
  std::optional<Frame> next(double timeout_s) { return handover_.next(timeout_s); }

  // The target's box, for automatic exposure; empty: no target.
  void set_region(const std::optional<cv::Rect2d>& target_box) { handover_.set_region(target_box); }
  // One exposure, with the software trigger; without it a call has no effect.
  void trigger() { handover_.ask_trigger(); }

  device::DeviceReport report() const;
  CameraState state() const { return handover_.facts().state; }
  CameraCounters counters() const { return handover_.facts().counters; }
  // The last error as text; empty: none yet.
  std::string last_error() const { return handover_.facts().last_error; }

  // For whoever takes the frames.
  const CameraConfig& config() const { return config_; }
  CameraHandover& handover() { return handover_; }

 private:
  const CameraConfig config_;
  CameraHandover handover_;
};

}  // namespace ols::camera
