#include "sim/camera/exposure_cue.h"

namespace ols::sim {

void ExposureCue::trigger(Trigger source) {
  {
    const std::lock_guard lock(mutex_);
    triggered_ = {source, Clock::now()};
  }
  changed_.notify_all();
}

void ExposureCue::client_spoke() {
  { const std::lock_guard lock(mutex_); }
  changed_.notify_all();
}

void ExposureCue::end() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  changed_.notify_all();
}

bool ExposureCue::wait_until(Clock::time_point time) {
  std::unique_lock lock(mutex_);
  return changed_.wait_until(lock, time, [this] { return ended_; });
}

bool ExposureCue::wait_for_client(Clock::duration longest) {
  std::unique_lock lock(mutex_);
  triggered_.reset();
  if (!ended_) changed_.wait_for(lock, longest);
  return ended_;
}

std::optional<ExposureCue::Triggered> ExposureCue::wait_for_trigger(Clock::duration longest) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, longest, [this] { return ended_ || triggered_; });
  return std::exchange(triggered_, std::nullopt);
}

}  // namespace ols::sim
