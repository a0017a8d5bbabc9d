#include "edge/device/device_thread.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <utility>

#include "base/process/clocks.h"

namespace ols::device {

DeviceThread::DeviceThread(const Config& config)
    : config_(config), pause_s_(config.first_pause_s) {}

void DeviceThread::start(Session session) {
  thread_ = std::jthread(
      [this, session = std::move(session)](const std::stop_token& stop) { run(stop, session); });
}

void DeviceThread::run(const std::stop_token& stop, const Session& session) {
  while (!stop.stop_requested()) {
    try {
      session(stop);
    } catch (const std::exception& failure) {
      failed(failure.what());
      pause(stop);
    }
  }
}

void DeviceThread::pause(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  wake_.wait_for(lock, stop, std::chrono::duration<double>(pause_s_), [] { return false; });
  pause_s_ = std::min(2.0 * pause_s_, config_.max_pause_s);
}

void DeviceThread::opened() {
  const std::lock_guard lock(mutex_);
  if (link_.openings++ == 0) link_.first_opened_s = clock_monotonic_s();
  link_.is_open = true;
}

void DeviceThread::works() { pause_s_ = config_.first_pause_s; }

void DeviceThread::failed(const std::string& failure) {
  const std::lock_guard lock(mutex_);
  link_.is_open = false;
  ++link_.failures;
  ++errors_;
  last_error_ = link_.failure = failure;
}

void DeviceThread::set_fault(const std::string& fault) {
  const std::lock_guard lock(mutex_);
  if (!fault.empty() && link_.fault.empty()) {
    ++errors_;
    last_error_ = fault;
  }
  link_.fault = fault;
}

DeviceThread::Link DeviceThread::link() const {
  const std::lock_guard lock(mutex_);
  return link_;
}

DeviceReport DeviceThread::report() const {
  const std::lock_guard lock(mutex_);
  DeviceReport r;
  r.name = config_.name;
  r.errors = errors_;
  r.last_error = last_error_;
  if (!thread_.joinable()) {
    r.text = "not configured";
  } else if (link_.is_open) {
    r.state = link_.fault.empty() ? DeviceState::kOk : DeviceState::kFault;
    r.text = link_.fault;
  } else if (errors_ == 0) {
    r.state = DeviceState::kStarting;
    r.text = config_.opening;
  } else {
    r.text = link_.failure;
    if (config_.alarm) r.alarms.push_back(config_.alarm(link_.failure));
  }
  return r;
}

}  // namespace ols::device
