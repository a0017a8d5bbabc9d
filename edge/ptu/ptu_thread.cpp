#include "edge/ptu/ptu_thread.h"

#include <atomic>
#include <mutex>
#include <stop_token>

#include "base/clocks.h"
#include "edge/device/device_thread.h"
#include "edge/ptu/ptu_report.h"
#include "edge/serial/serial_port.h"

namespace ols::ptu {

namespace {

constexpr double kTick_s = 0.003;      // maximum time between two steps of the driver
constexpr double kFirstPause_s = 0.2;  // before the port is opened again; doubles
constexpr double kMaxPause_s = 2.0;
constexpr double kHaltOut_s = 0.25;  // for the last halt, behind a whole request at 9600 baud

}  // namespace

struct PtuThread::Impl {
  explicit Impl(const PtuConfig& ptu_config)
      : config(ptu_config),
        driver(ptu_config),
        thread({"ptu", "is being opened", kFirstPause_s, kMaxPause_s}) {
    driver.allow_rehoming(false);
  }

  void run(const std::stop_token& stop) {
    serial::SerialPort port(config.device, line_baud(), serial::Parity::kNone, &wakeup);
    restart_after_failure();
    thread.opened();
    thread.works();
    serve(port, stop);
    // The process ends, or the port is to be opened again: the unit must stand meanwhile.
    port.write_first(halt_request());
    port.drain(kHaltOut_s);
  }

  // Returns when the port must be opened again or the thread must stop. Throws when the port fails.
  void serve(serial::SerialPort& port, const std::stop_token& stop) {
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
        reopens += link_lost ? 1 : 0;
      }
      if (wanted_rate != rate) port.set_baud(rate = wanted_rate);
      if (!request.empty()) port.write(request);
      if (link_lost) return;
    }
  }

  // Only this thread writes, so that no motion command slips in behind the halt.
  void heed_emergency(serial::SerialPort& port) {
    wakeup.clear();
    if (!halt_wanted.exchange(false)) return;
    std::string halt;
    {
      const std::lock_guard lock(mutex);
      halt = driver.emergency_halt(clock_monotonic_s());
      if (!emergency) driver.clear_emergency();  // already cleared; the halt is sent all the same
    }
    if (!port.write_first(halt)) port.write(halt);
  }

  int line_baud() const {
    const std::lock_guard lock(mutex);
    return driver.line_baud();
  }

  // A port that was closed only because the unit was silent does not restart the driver, which
  // keeps its own pauses.
  void restart_after_failure() {
    if (thread.link().is_open) return;
    const std::lock_guard lock(mutex);
    driver.restart(clock_monotonic_s());
  }

  const PtuConfig config;
  Wakeup wakeup;
  std::atomic<bool> emergency = false;
  std::atomic<bool> halt_wanted = false;  // not on the line yet
  mutable std::mutex mutex;               // of everything below but the thread
  PtuDriver driver;
  std::uint64_t reopens = 0;
  device::DeviceThread thread;  // last: it uses the rest
};

PtuThread::PtuThread(const PtuConfig& config) : impl_(std::make_unique<Impl>(config)) {
  impl_->thread.start([impl = impl_.get()](const std::stop_token& stop) { impl->run(stop); });
}

PtuThread::~PtuThread() = default;

void PtuThread::set_goal(const std::optional<ServoGoal>& goal) {
  const std::lock_guard lock(impl_->mutex);
  impl_->driver.set_goal(impl_->emergency ? std::nullopt : goal);
}

std::vector<AngleSample> PtuThread::take_samples() {
  const std::lock_guard lock(impl_->mutex);
  return impl_->driver.take_samples();
}

// Without the lock: it must not wait for the thread.
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
  return impl_->thread.link().is_open ? impl_->driver.reference() : PtuReference::kUnknown;
}

std::optional<PtuReferenceDoubt> PtuThread::doubt_to_persist() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->driver.doubt_to_persist();
}

PtuStatus PtuThread::status() const {
  const std::lock_guard lock(impl_->mutex);
  const PtuDriver& driver = impl_->driver;
  PtuStatus status;
  const device::DeviceThread::Link link = impl_->thread.link();
  status.port = {link.is_open, link.failures, impl_->reopens};
  status.state = link.is_open || link.failures == 0 ? driver.state() : PtuState::kFault;
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
  status.last_error = link.is_open ? driver.last_error() : link.failure;
  return status;
}

device::DeviceReport PtuThread::report() const {
  return ptu_report(impl_->config, status(), clock_monotonic_s());
}

}  // namespace ols::ptu
