#include "edge/process/detector_thread.h"

#include <chrono>
#include <utility>

#include "base/process/time_source.h"
#include "edge/device/behind_control_loop.h"

namespace ols::station {

DetectorThread::DetectorThread(const detector::DetectorConfig& config)
    : detector_(config), thread_([this](const std::stop_token& stop) { work(stop); }) {}

void DetectorThread::give(detector::Picture picture) {
  const std::lock_guard lock(mutex_);
  picture_ = std::move(picture);
  works_ = true;
  arrived_.notify_one();
}

std::optional<detector::Found> DetectorThread::take() {
  constexpr double kSmoothing = 0.1;
  std::unique_lock lock(mutex_);
  found_.wait_for(lock, time_source().for_work(), [this] { return !works_; });
  if (result_) picture_s_ += kSmoothing * (taken_s_ - picture_s_);
  return std::exchange(result_, std::nullopt);
}

void DetectorThread::work(const std::stop_token& stop) {
  device::go_behind_control_loop();
  using Clock = std::chrono::steady_clock;
  std::unique_lock lock(mutex_);
  while (arrived_.wait(lock, stop, [this] { return picture_.has_value(); })) {
    const detector::Picture picture = *std::exchange(picture_, std::nullopt);
    lock.unlock();
    const auto began = Clock::now();
    detector::Found found = detector_.look(picture);
    const std::chrono::duration<double> taken = Clock::now() - began;
    lock.lock();
    taken_s_ = taken.count();
    result_ = std::move(found);
    works_ = false;
    found_.notify_one();
  }
}

}  // namespace ols::station
