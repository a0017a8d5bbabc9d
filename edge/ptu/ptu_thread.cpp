#include "edge/ptu/ptu_thread.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <stop_token>
#include <thread>

#include "base/clocks.h"
#include "edge/ptu/ptu_report.h"
#include "edge/ptu/serial_port.h"

namespace ols {

namespace {

constexpr double kTick_s = 0.003;      // the driver is stepped at least so often
constexpr double kFirstPause_s = 0.2;  // before the port is opened again; doubles
constexpr double kLongestPause_s = 2.0;
constexpr double kHaltOut_s = 0.25;  // for the last halt, behind a whole request at 9600 baud

}  // namespace

struct PtuThread::Impl {
  explicit Impl(const PtuConfig& ptu_config) : config(ptu_config), driver(ptu_config) {
    driver.allow_rehoming(false);
  }

  void run(const std::stop_token& stop) {
    double pause_s = kFirstPause_s;
    while (!stop.stop_requested()) {
      try {
        SerialPort port(config.device, line_baud(), Parity::kNone, &wakeup);
        set_open();
        pause_s = kFirstPause_s;
        serve(port, stop);
        // The process ends, or the port is opened anew: the unit stands meanwhile.
        port.write_first(halt_request());
        port.drain(kHaltOut_s);
      } catch (const std::exception& failure) {
        note_failure(failure.what());
        std::unique_lock lock(mutex);
        wake.wait_for(lock, stop, std::chrono::duration<double>(pause_s), [] { return false; });
        pause_s = std::min(2.0 * pause_s, kLongestPause_s);
      }
    }
  }

  // Until the port fails, which throws, or is to be opened anew, or the thread is to stop.
  void serve(SerialPort& port, const std::stop_token& stop) {
    int rate = line_baud();
    while (!stop.stop_requested()) {
      heed_emergency(port);
      const std::string arrived = port.read(kTick_s);
      std::string request;
      bool link_lost = false;
      int wanted_rate = rate;
      {
        const std::lock_guard lock(mutex);
        driver.receive(arrived, clock_monotonic_s());
        if (!halt_wanted) request = driver.step(clock_monotonic_s());
        wanted_rate = driver.line_baud();
        link_lost = driver.take_link_loss();
        port_status.reopens += link_lost ? 1 : 0;
      }
      if (wanted_rate != rate) port.set_baud(rate = wanted_rate);
      if (!request.empty()) port.write(request);
      if (link_lost) return;
    }
  }

  // Only this thread writes, so that no motion command slips in behind the halt.
  void heed_emergency(SerialPort& port) {
    wakeup.clear();
    if (!halt_wanted.exchange(false)) return;
    std::string halt;
    {
      const std::lock_guard lock(mutex);
      halt = driver.emergency_halt(clock_monotonic_s());
      if (!emergency)
        driver.clear_emergency();  // called off already; the halt goes out all the same
    }
    if (!port.write_first(halt)) port.write(halt);
  }

  int line_baud() const {
    const std::lock_guard lock(mutex);
    return driver.line_baud();
  }

  void set_open() {
    const std::lock_guard lock(mutex);
    // After a mere silence the driver goes on with its own pauses.
    if (!port_status.open) driver.restart(clock_monotonic_s());
    port_status.open = true;
  }

  void note_failure(const std::string& what) {
    const std::lock_guard lock(mutex);
    port_status.open = false;
    ++port_status.failures;
    port_error = what;
  }

  const PtuConfig config;
  Wakeup wakeup;
  std::atomic<bool> emergency = false;
  std::atomic<bool> halt_wanted = false;  // not on the line yet
  mutable std::mutex mutex;               // of everything below
  std::condition_variable_any wake;
  PtuDriver driver;
  PtuStatus::Port port_status;
  std::string port_error;
  std::jthread thread;  // last: it uses the rest
};

PtuThread::PtuThread(const PtuConfig& config) : impl_(std::make_unique<Impl>(config)) {
  impl_->thread = std::jthread([this](const std::stop_token& stop) { impl_->run(stop); });
}

PtuThread::~PtuThread() = default;  // the jthread asks to stop and joins

void PtuThread::set_goal(const std::optional<ServoGoal>& goal) {
  const std::lock_guard lock(impl_->mutex);
  impl_->driver.set_goal(impl_->emergency ? std::nullopt : goal);
}

std::vector<AngleSample> PtuThread::take_samples() {
  const std::lock_guard lock(impl_->mutex);
  return impl_->driver.take_samples();
}

// Without the lock: it must not wait for whatever the thread is doing.
void PtuThread::emergency_halt() {
  impl_->emergency = true;
  impl_->halt_wanted = true;
  impl_->wakeup.set();
}

void PtuThread::clear_emergency() {
  const std::lock_guard lock(impl_->mutex);
  impl_->emergency = false;
  impl_->driver.clear_emergency();
}

void PtuThread::home() {
  const std::lock_guard lock(impl_->mutex);
  if (!impl_->emergency) impl_->driver.home(clock_monotonic_s());
}

void PtuThread::stop_homing() {
  const std::lock_guard lock(impl_->mutex);
  impl_->driver.stop_homing(clock_monotonic_s());
}

void PtuThread::allow_rehoming(bool allowed) {
  const std::lock_guard lock(impl_->mutex);
  impl_->driver.allow_rehoming(allowed);
}

void PtuThread::restore_doubt(const std::optional<PtuReferenceDoubt>& doubt) {
  const std::lock_guard lock(impl_->mutex);
  impl_->driver.restore_doubt(doubt);
}

void PtuThread::reference_ok() {
  const std::lock_guard lock(impl_->mutex);
  impl_->driver.reference_ok();
}

PtuReference PtuThread::reference() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->port_status.open ? impl_->driver.reference() : PtuReference::kUnknown;
}

std::optional<PtuReferenceDoubt> PtuThread::doubt_to_persist() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->driver.doubt_to_persist();
}

PtuStatus PtuThread::status() const {
  const std::lock_guard lock(impl_->mutex);
  const PtuDriver& driver = impl_->driver;
  PtuStatus status;
  status.port = impl_->port_status;
  status.state = impl_->port_status.open || impl_->port_status.failures == 0 ? driver.state()
                                                                             : PtuState::kFault;
  status.emergency = impl_->emergency;
  status.standing = driver.standing();
  status.not_referenced = driver.not_referenced();
  status.homing = driver.homing();
  status.doubt = driver.doubt();
  status.lowered_speed = driver.lowered_speed();
  status.line_baud = driver.line_baud();
  status.last_good_s = driver.last_good_s();
  status.environment = driver.environment();
  status.counters = driver.counters();
  status.limits = driver.limits();
  status.firmware = driver.firmware();
  status.last_error = impl_->port_status.open ? driver.last_error() : impl_->port_error;
  return status;
}

DeviceReport PtuThread::report() const {
  return ptu_report(impl_->config, status(), clock_monotonic_s());
}

}  // namespace ols
