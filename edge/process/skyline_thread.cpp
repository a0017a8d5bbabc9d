#include "edge/process/skyline_thread.h"

#include <cmath>
#include <utility>

#include "edge/device/behind_control_loop.h"
#include "geometry/angles.h"

namespace ols::station {

SkylineThread::SkylineThread(std::shared_ptr<const land::Surface> land)
    : watch_(std::move(land)), thread_([this](const std::stop_token& stop) { work(stop); }) {}

bool SkylineThread::wants(double now_s, const PanTilt& reported) {
  constexpr double kInterval_s = 5.0, kStill_rad = radians(0.02);
  const PanTilt before = std::exchange(before_, reported);
  if (now_s < due_s_ || std::abs(reported.pan_rad - before.pan_rad) > kStill_rad ||
      std::abs(reported.tilt_rad - before.tilt_rad) > kStill_rad) {
    return false;
  }
  const std::lock_guard lock(mutex_);
  if (works_) return false;
  due_s_ = now_s + kInterval_s;
  return true;
}

void SkylineThread::give(video::VideoFrame picture) {
  const std::lock_guard lock(mutex_);
  picture_ = std::move(picture);
  works_ = true;
  arrived_.notify_one();
}

void SkylineThread::forget() {
  const std::lock_guard lock(mutex_);
  if (std::exchange(picture_, std::nullopt)) works_ = false;
  forgets_ = true;
  alarm_ = {};
}

Alarm SkylineThread::alarm() const {
  const std::lock_guard lock(mutex_);
  return alarm_;
}

void SkylineThread::work(const std::stop_token& stop) {
  device::go_behind_control_loop();
  std::unique_lock lock(mutex_);
  while (arrived_.wait(lock, stop, [this] { return picture_.has_value(); })) {
    const video::VideoFrame picture = *std::exchange(picture_, std::nullopt);
    if (std::exchange(forgets_, false)) watch_.forget();
    lock.unlock();
    watch_.look(picture.gray, *picture.camera);
    Alarm found = watch_.alarm();
    lock.lock();
    if (!forgets_) alarm_ = std::move(found);
    works_ = false;
  }
}

}  // namespace ols::station
