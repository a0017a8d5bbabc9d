#include "edge/ptu/ptu_thread.h"

#include <stop_token>

#include "base/process/wakeup.h"
#include "edge/serial/serial_port.h"

namespace ols::ptu {

namespace {

constexpr double kTick_s = 0.003;      // maximum time between two steps of the driver
constexpr double kFirstPause_s = 0.2;  // before the port is opened again; doubles
constexpr double kMaxPause_s = 2.0;
constexpr double kHaltOut_s = 0.25;  // for the last halt, behind a whole request at 9600 baud

}  // namespace

struct PtuThread::Impl {
  Impl(PtuHandover& shared, std::string serial_device)
      : ptu(shared),
        device(std::move(serial_device)),
        thread({"ptu", "is being opened", kFirstPause_s, kMaxPause_s}) {}

  void run(const std::stop_token& stop) {
    serial::SerialPort port(device, ptu.line_baud(), serial::Parity::kNone, &wakeup);
    // A port that was closed only because the unit was silent does not restart the driver, which
    // keeps its own pauses.
    if (!thread.link().is_open) ptu.restart();
    thread.opened();
    thread.works();
    serve(port, stop);
    // The process ends, or the port is to be opened again: the unit must stand meanwhile.
    port.write_first(halt_request());
    port.drain(kHaltOut_s);
  }

  // Returns when the port must be opened again or the thread must stop. Throws when the port fails.
  void serve(serial::SerialPort& port, const std::stop_token& stop) {
    int rate = ptu.line_baud();
    while (!stop.stop_requested()) {
      heed_emergency(port);
      const Turn turn = ptu.turn(port.read(kTick_s));
      if (turn.baud != rate) port.set_baud(rate = turn.baud);
      if (!turn.request.empty()) port.write(turn.request);
      if (turn.link_lost) return;
    }
  }

  // Only this thread writes, so that no motion command slips in behind the halt.
  void heed_emergency(serial::SerialPort& port) {
    wakeup.clear();
    const auto halt = ptu.take_halt();
    if (halt && !port.write_first(*halt)) port.write(*halt);
  }

  PtuHandover& ptu;
  const std::string device;
  Wakeup wakeup;
  device::DeviceThread thread;  // last: it uses the rest
};

PtuThread::PtuThread(const PtuConfig& config)
    : PtuHandover(config), impl_(std::make_unique<Impl>(*this, config.device)) {
  impl_->thread.start([impl = impl_.get()](const std::stop_token& stop) { impl->run(stop); });
}

PtuThread::~PtuThread() = default;

device::DeviceThread::Link PtuThread::link() const { return impl_->thread.link(); }

void PtuThread::wake() { impl_->wakeup.set(); }

}  // namespace ols::ptu
