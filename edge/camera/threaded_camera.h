// A camera with a thread of its own, which opens it, and opens it again after each failure.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <thread>

#include "edge/camera/camera.h"
#include "edge/camera/camera_config.h"
#include "edge/camera/camera_handover.h"

namespace ols::camera {

// What each kind of camera does in that thread.
class CameraSource {
 public:
  CameraSource() = default;
  virtual ~CameraSource() = default;
  CameraSource(const CameraSource&) = delete;
  CameraSource& operator=(const CameraSource&) = delete;

  // Opens the camera, and hands over its frames until the handover has ended. Throws CameraUnfit
  // if the configuration does not suit the camera, or any other exception if it is absent or lost.
  virtual void serve() = 0;
  // The time from a failure until the camera is opened again.
  virtual double pause_s() = 0;
};

class ThreadedCamera : public Camera {
 public:
  using MakeSource = std::function<std::unique_ptr<CameraSource>(CameraHandover&)>;
  // Starts to look for the camera and returns at once.
  ThreadedCamera(const CameraConfig& config, const MakeSource& make_source);
  ~ThreadedCamera() override;

  std::optional<Frame> next(double timeout_s) override { return handover_.next(timeout_s); }
  void set_region(const std::optional<cv::Rect2d>& target_box) override {
    handover_.set_region(target_box);
  }
  void trigger() override { handover_.ask_trigger(); }
  device::DeviceReport report() const override;
  CameraFacts facts() const { return handover_.facts(); }

 private:
  void run();

  const CameraConfig config_;
  CameraHandover handover_;
  const std::unique_ptr<CameraSource> source_;
  std::thread thread_;  // last: it uses the rest
};

}  // namespace ols::camera
