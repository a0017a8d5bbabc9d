#include "edge/camera/aravis/aravis_camera.h"

#include <future>
#include <thread>
#include <utility>

#include "base/process/clocks.h"
#include "edge/camera/aravis/aravis_device.h"
#include "edge/camera/aravis/aravis_session.h"
#include "edge/camera/camera_handover.h"

namespace ols::camera {

struct AravisCamera::Impl {
  explicit Impl(const AravisConfig& config) : config_(config) {
    thread_ = std::thread([this] { run(); });
  }
  ~Impl() {
    handover_.end();
    thread_.join();
  }

  void run();
  void close(std::unique_ptr<AravisDevice> device);

  const AravisConfig config_;
  CameraHandover handover_;
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
      handover_.note_failure(CameraState::kFault, error.alarm);
    } catch (const CameraAbsent& error) {
      handover_.note_failure(CameraState::kAbsent, error.alarm);
    } catch (const std::exception& error) {
      handover_.note_failure(CameraState::kAbsent, {error.what(), {}, {}});
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

AravisCamera::AravisCamera(const AravisConfig& config) : impl_(std::make_unique<Impl>(config)) {}
AravisCamera::~AravisCamera() = default;

std::optional<Frame> AravisCamera::next(double timeout_s) {
  return impl_->handover_.next(timeout_s);
}

void AravisCamera::set_region(const std::optional<cv::Rect2d>& target_box) {
  impl_->handover_.set_region(target_box);
}

void AravisCamera::trigger() { impl_->handover_.ask_trigger(); }

device::DeviceReport AravisCamera::report() const {
  return make_camera_report(impl_->config_, impl_->handover_.facts(), clock_monotonic_s());
}

CameraState AravisCamera::state() const { return impl_->handover_.facts().state; }

CameraCounters AravisCamera::counters() const { return impl_->handover_.facts().counters; }

std::string AravisCamera::last_error() const { return impl_->handover_.facts().last_error; }

}  // namespace ols::camera
