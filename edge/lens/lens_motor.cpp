#include "edge/lens/lens_motor.h"

#include <stdexcept>
#include <stop_token>

#include "conditions/alarms.h"
#include "edge/device/device_thread.h"
#include "edge/serial/serial_port.h"

namespace ols::lens {
namespace {

constexpr double kRead_s = 0.005;  // a reply takes about 20 ms
constexpr double kFirstPause_s = 0.2, kMaxPause_s = 5.0;

}  // namespace

struct LensMotor::Impl {
  Impl(LensHandover& shared, const LensMotorConfig& c)
      : lens(shared),
        config(c),
        thread({"lens", "is being opened", kFirstPause_s, kMaxPause_s, alarm::lens_fails}) {}

  void run(const std::stop_token& stop) {
    serial::SerialPort port(config.device, config.baud);
    thread.opened();
    lens.restart();
    while (!stop.stop_requested()) {
      const Turn turn = lens.turn(port.read(kRead_s));
      if (turn.works) thread.works();
      if (turn.link_lost) throw std::runtime_error("does not answer");
      if (!turn.request.empty()) port.write(turn.request);
    }
  }

  LensHandover& lens;
  const LensMotorConfig config;
  device::DeviceThread thread;  // last: it uses the rest
};

LensMotor::LensMotor(const LensMotorConfig& config)
    : LensHandover(config), impl_(std::make_unique<Impl>(*this, config)) {
  if (config.device.empty()) return;
  impl_->thread.start([impl = impl_.get()](const std::stop_token& stop) { impl->run(stop); });
}

LensMotor::~LensMotor() = default;

device::DeviceReport LensMotor::line() const {
  device::DeviceReport report = impl_->thread.report();
  const std::uint64_t openings = impl_->thread.link().openings;
  report.counters["lens_reopened"] = openings > 0 ? openings - 1 : 0;
  return report;
}

}  // namespace ols::lens
