#include "edge/camera/aravis/aravis_camera.h"

#include <future>

#include "edge/camera/aravis/aravis_device.h"
#include "edge/camera/aravis/aravis_session.h"

namespace ols::camera {
namespace {

class AravisSource : public CameraSource {
 public:
  AravisSource(const AravisConfig& config, CameraHandover& handover)
      : config_(config), handover_(handover) {}

  void serve() override {
    const auto close = [this](AravisDevice* device) { close_behind(device); };
    const std::unique_ptr<AravisDevice, decltype(close)> device(
        std::make_unique<AravisDevice>(config_).release(), close);
    AravisSession(config_, *device, numbers_, handover_).stream();
  }
  // Aravis itself retries a camera that does not answer, for 2.5 s.
  double pause_s() override { return config_.retry_s; }

 private:
  // In its own thread: a camera that came back must not wait for the disconnection from the lost
  // one, which may take seconds. One at a time.
  void close_behind(AravisDevice* device) {
    closing_ =
        std::async(std::launch::async,
                   [gone = std::unique_ptr<AravisDevice>(device)]() mutable { gone.reset(); });
  }

  const AravisConfig config_;
  CameraHandover& handover_;
  FrameNumbers numbers_;
  std::future<void> closing_;  // of the last device
};

}  // namespace

AravisCamera::AravisCamera(const AravisConfig& config)
    : ThreadedCamera(config, [&config](CameraHandover& handover) {
        return std::make_unique<AravisSource>(config, handover);
      }) {}

}  // namespace ols::camera
