#include "edge/ptu/ptu_thread.h"

#include <time.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <stop_token>
#include <thread>

#include "base/clocks.h"
#include "edge/ptu/serial_port.h"

namespace ols {

namespace {

constexpr double kTick_s = 0.003;      // the driver is stepped at least so often
constexpr double kFirstPause_s = 0.2;  // before the port is opened again; doubles
constexpr double kLongestPause_s = 2.0;
constexpr double kHaltOut_s = 0.25;  // for the last halt, behind a whole request at 9600 baud

}  // namespace

struct PtuThread::Impl {
  explicit Impl(const PtuConfig& ptu_config) : config(ptu_config), driver(ptu_config) {}

  void run(const std::stop_token& stop) {
    double pause_s = kFirstPause_s;
    while (!stop.stop_requested()) {
      try {
        SerialPort port(config.device, config.baud);
        set_open(true);
        pause_s = kFirstPause_s;
        serve(port, stop);
        // The process ends: the unit stands before its master is gone.
        port.write(PtuDriver::halt_request());
        port.drain(kHaltOut_s);
      } catch (const std::exception& failure) {
        note_failure(failure.what());
        std::unique_lock lock(mutex);
        wake.wait_for(lock, stop, std::chrono::duration<double>(pause_s), [] { return false; });
        pause_s = std::min(2.0 * pause_s, kLongestPause_s);
      }
    }
  }

  // Until the port fails, which throws, or the thread is to stop.
  void serve(SerialPort& port, const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      const std::string arrived = port.read(kTick_s);
      std::string request;
      {
        const std::lock_guard lock(mutex);
        driver.receive(arrived, clock_monotonic_s());
        request = driver.step(clock_monotonic_s());
      }
      if (!request.empty()) port.write(request);
    }
  }

  void set_open(bool is_open) {
    const std::lock_guard lock(mutex);
    open = is_open;
    if (is_open) driver.restart(clock_monotonic_s());
  }

  void note_failure(const std::string& what) {
    const std::lock_guard lock(mutex);
    open = false;
    ++port_failures;
    port_error = what;
  }

  const PtuConfig config;
  mutable std::mutex mutex;  // of everything below
  std::condition_variable_any wake;
  PtuDriver driver;
  bool open = false;
  std::uint64_t port_failures = 0;
  std::string port_error;
  std::jthread thread;  // last: it uses the rest
};

PtuThread::PtuThread(const PtuConfig& config) : impl_(std::make_unique<Impl>(config)) {
  impl_->thread = std::jthread([this](const std::stop_token& stop) { impl_->run(stop); });
}

PtuThread::~PtuThread() = default;  // the jthread asks to stop and joins

void PtuThread::set_goal(const std::optional<ServoGoal>& goal) {
  const std::lock_guard lock(impl_->mutex);
  impl_->driver.set_goal(goal);
}

std::vector<AngleSample> PtuThread::take_samples() {
  const std::lock_guard lock(impl_->mutex);
  return impl_->driver.take_samples();
}

PtuStatus PtuThread::status() const {
  const std::lock_guard lock(impl_->mutex);
  const PtuDriver& driver = impl_->driver;
  PtuStatus status;
  status.port_open = impl_->open;
  status.state = impl_->open || impl_->port_failures == 0 ? driver.state() : PtuState::kFault;
  status.port_failures = impl_->port_failures;
  status.counters = driver.counters();
  status.limits = driver.limits();
  status.pan_resolution_rad = driver.pan_resolution_rad();
  status.tilt_resolution_rad = driver.tilt_resolution_rad();
  status.firmware = driver.firmware();
  status.last_error = impl_->open ? driver.last_error() : impl_->port_error;
  return status;
}

}  // namespace ols
