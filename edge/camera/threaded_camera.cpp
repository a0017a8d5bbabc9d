#include "edge/camera/threaded_camera.h"

#include "base/process/clocks.h"
#include "edge/camera/camera_errors.h"

namespace ols::camera {

ThreadedCamera::ThreadedCamera(const CameraConfig& config, const MakeSource& make_source)
    : config_(config), source_(make_source(handover_)), thread_([this] { run(); }) {}

ThreadedCamera::~ThreadedCamera() {
  handover_.end();
  thread_.join();
}

void ThreadedCamera::run() {
  while (!handover_.ended()) {
    try {
      source_->serve();
      continue;
    } catch (const CameraUnfit& error) {
      handover_.note_failure(CameraState::kFault, error.alarm);
    } catch (const CameraAbsent& error) {
      handover_.note_failure(CameraState::kAbsent, error.alarm);
    } catch (const std::exception& error) {
      handover_.note_failure(CameraState::kAbsent, {error.what(), {}, {}});
    }
    handover_.wait(source_->pause_s());
  }
}

device::DeviceReport ThreadedCamera::report() const {
  return make_camera_report(config_, handover_.facts(), clock_monotonic_s());
}

}  // namespace ols::camera
