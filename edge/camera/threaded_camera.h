// A camera with its own thread. The thread opens the camera, and opens it again after each failure.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <thread>

#include "edge/camera/camera.h"
#include "edge/camera/camera_config.h"
#include "edge/camera/camera_handover.h"

namespace ols::camera {

// The part of that thread that differs between kinds of cameras.
class CameraSource {
 public:
  CameraSource() = default;
  virtual ~CameraSource() = default;
  CameraSource(const CameraSource&) = delete;
  CameraSource& operator=(const CameraSource&) = delete;

  // Opens the camera, and publishes its frames to the CameraHandover until ended() is true. Throws
  // CameraUnfit if the configuration does not suit the camera, or another exception if the camera
  // is absent or lost.
  virtual void serve() = 0;
  // The pause between a failure and the next attempt to open the camera.
  virtual double pause_s() = 0;
};

class ThreadedCamera : public Camera {
 public:
  using MakeSource = std::function<std::unique_ptr<CameraSource>(CameraHandover&)>;
  // Returns at once; the thread that it starts connects to the camera.
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
  std::thread thread_;  // the last member, because the thread uses the others
};

}  // namespace ols::camera
