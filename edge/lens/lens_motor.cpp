#include "edge/lens/lens_motor.h"

#include <mutex>
#include <stdexcept>
#include <stop_token>

#include "base/process/clocks.h"
#include "conditions/alarms.h"
#include "edge/device/device_thread.h"
#include "edge/device/reading_queue.h"
#include "edge/lens/lens_driver.h"
#include "edge/serial/serial_port.h"

namespace ols::lens {
namespace {

constexpr double kRead_s = 0.005;  // a reply takes about 20 ms
constexpr double kFirstPause_s = 0.2, kMaxPause_s = 5.0;

}  // namespace

struct LensMotor::Impl {
  explicit Impl(const LensMotorConfig& c)
      : config(c),
        driver(c.poll_interval_s),
        thread({"lens", "is being opened", kFirstPause_s, kMaxPause_s, alarm::lens_fails}) {}

  void run(const std::stop_token& stop) {
    serial::SerialPort port(config.device, config.baud);
    thread.opened();
    {
      const std::lock_guard lock(mutex);
      driver.restart();
    }
    while (!stop.stop_requested()) turn(port);
  }

  void turn(serial::SerialPort& port) {
    const std::string heard = port.read(kRead_s);
    std::string request;
    {
      const std::lock_guard lock(mutex);
      const double now_s = clock_monotonic_s();
      driver.receive(heard, now_s);
      request = driver.step(now_s);
      for (const ZoomSample& sample : driver.take_samples()) {
        samples.add(sample);
        thread.works();
      }
      if (driver.take_link_loss()) throw std::runtime_error("does not answer");
    }
    if (!request.empty()) port.write(request);
  }

  device::DeviceReport report() const {
    const std::lock_guard lock(mutex);
    device::DeviceReport r = thread.report();
    const LensState& state = driver.state();
    if (r.state == device::DeviceState::kOk) {
      r.text = state.ready ? state.version : "waiting for its positions";
      if (!state.ready) r.state = device::DeviceState::kStarting;
    }
    r.last_good_s = state.last_good_s;
    const LensCounters counters = driver.counters();
    const std::uint64_t openings = thread.link().openings;
    r.counters = {
        {"lens_requests", counters.requests}, {"lens_replies", counters.replies},
        {"lens_timeouts", counters.timeouts}, {"lens_refusals", counters.refusals},
        {"lens_garbled", counters.garbled},   {"lens_reopened", openings > 0 ? openings - 1 : 0}};
    return r;
  }

  const LensMotorConfig config;
  mutable std::mutex mutex;  // of everything below but the thread
  LensDriver driver;
  device::ReadingQueue<ZoomSample> samples;
  device::DeviceThread thread;  // last: it uses the rest
};

LensMotor::LensMotor(const LensMotorConfig& config) : impl_(std::make_unique<Impl>(config)) {
  if (config.device.empty()) return;
  impl_->thread.start([impl = impl_.get()](const std::stop_token& stop) { impl->run(stop); });
}

LensMotor::~LensMotor() = default;

void LensMotor::order(const LensOrder& order) {
  const std::lock_guard lock(impl_->mutex);
  impl_->driver.order(order);
}

std::vector<ZoomSample> LensMotor::take_samples() {
  const std::lock_guard lock(impl_->mutex);
  return impl_->samples.take();
}

ByAxis<std::optional<double>> LensMotor::positions() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->driver.state().positions;
}

device::DeviceReport LensMotor::report() const { return impl_->report(); }

}  // namespace ols::lens
