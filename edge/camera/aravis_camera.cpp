#include "edge/camera/aravis_camera.h"

#include <future>
#include <thread>
#include <utility>

#include "edge/camera/aravis_device.h"
#include "edge/camera/aravis_session.h"
#include "edge/camera/camera_handover.h"

namespace ols::camera {

struct AravisCamera::Impl {
  explicit Impl(Camera& camera) : config_(camera.config()), handover_(camera.handover()) {
    thread_ = std::thread([this] { run(); });
  }
  ~Impl() {
    handover_.end();
    thread_.join();
  }

  void run();
  void close(std::unique_ptr<AravisDevice> device);

  const CameraConfig& config_;
  CameraHandover& handover_;
  FrameNumbers numbers_;
  std::future<void> closing_;  // destroys the last device, which may take seconds
  std::thread thread_;
};

void AravisCamera::Impl::run() {
  while (!handover_.ended()) {
    std::unique_ptr<AravisDevice> device;
    try {
      device = std::make_unique<AravisDevice>(config_);
      AravisSession(config_, *device, numbers_, handover_).stream();
    } catch (const CameraUnfit& error) {
      handover_.note_failure(CameraState::kFault, error.what());
    } catch (const std::exception& error) {
      handover_.note_failure(CameraState::kAbsent, error.what());
    }
    if (device) close(std::move(device));
    // Aravis itself retries a camera that does not answer, for 2.5 s.
    handover_.wait(config_.retry_s);
  }
}

// In its own thread: a camera that came back must not wait for the disconnection from the lost one.
// One at a time.
void AravisCamera::Impl::close(std::unique_ptr<AravisDevice> device) {
  closing_ = std::async(std::launch::async, [gone = std::move(device)]() mutable { gone.reset(); });
}

AravisCamera::AravisCamera(const CameraConfig& config)
    : Camera(config), impl_(std::make_unique<Impl>(*this)) {}
AravisCamera::~AravisCamera() = default;

}  // namespace ols::camera
