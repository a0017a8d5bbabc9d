#include "edge/process/skyline_thread.h"

#include <exception>
#include <utility>

#include "base/process/time_source.h"
#include "conditions/alarms.h"
#include "edge/device/behind_control_loop.h"
#include "land/terrain_folder.h"

namespace ols::station {

SkylineThread::SkylineThread(const std::string& folder)
    : thread_([this, folder](const std::stop_token& stop) { work(stop, folder); }) {}

bool SkylineThread::wants(double now_s) const {
  const std::lock_guard lock(mutex_);
  return has_land_ && !works_ && now_s >= due_s_;
}

void SkylineThread::give(skyline::StatedPicture picture) {
  constexpr double kInterval_s = 5.0;
  const std::lock_guard lock(mutex_);
  due_s_ = picture.mid_exposure_s + kInterval_s;
  picture_ = std::move(picture);
  works_ = true;
  arrived_.notify_one();
}

void SkylineThread::follow(int setup) {
  const std::lock_guard lock(mutex_);
  if (std::exchange(setup_, setup) == setup || !has_land_) return;
  if (std::exchange(picture_, std::nullopt)) works_ = false;
  forgets_ = true;
  alarm_ = {};
}

Alarm SkylineThread::alarm() const {
  std::unique_lock lock(mutex_);
  done_.wait_for(lock, time_source().for_work(), [this] { return !works_; });
  return alarm_;
}

bool SkylineThread::read_land(const std::stop_token& stop, const std::string& folder) {
  Alarm alarm;
  try {
    watch_.emplace(land::read_terrain_folder(folder, stop).terrain);
  } catch (const std::exception& wrong) {
    alarm = alarm::skyline_not_compared(wrong.what());
  }
  const std::lock_guard lock(mutex_);
  has_land_ = watch_.has_value();
  alarm_ = std::move(alarm);
  works_ = false;
  done_.notify_all();
  return has_land_;
}

void SkylineThread::compare(const skyline::StatedPicture& picture) {
  Alarm alarm;
  try {
    watch_->look(picture);
    alarm = watch_->alarm();
  } catch (const std::exception& wrong) {
    alarm = alarm::skyline_not_compared(wrong.what());
  }
  const std::lock_guard lock(mutex_);
  if (!forgets_) alarm_ = std::move(alarm);
  works_ = false;
  done_.notify_all();
}

void SkylineThread::work(const std::stop_token& stop, const std::string& folder) {
  device::go_behind_control_loop();
  if (!read_land(stop, folder)) return;
  std::unique_lock lock(mutex_);
  while (arrived_.wait(lock, stop, [this] { return picture_.has_value(); }) &&
         !stop.stop_requested()) {
    const skyline::StatedPicture picture = *std::exchange(picture_, std::nullopt);
    if (std::exchange(forgets_, false)) watch_->forget();
    lock.unlock();
    compare(picture);
    lock.lock();
  }
}

}  // namespace ols::station
