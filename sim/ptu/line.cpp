#include "sim/ptu/line.h"

#include <algorithm>
#include <mutex>
#include <stop_token>
#include <thread>

#include "base/process/clocks.h"
#include "sim/ptu/faults.h"
#include "sim/serial/pty.h"

namespace ols::sim {

namespace {

constexpr double kLongestSleep_s = 0.02;  // so that it ends promptly
constexpr double kBatch_s = 1e-3;         // bytes within this time are passed on together

}  // namespace

struct PtuLine::Impl {
  Impl(const PtuUnitConfig& config, std::uint64_t seed, const std::string& link)
      : unit(config, seed, clock_monotonic_s()), pty(link), device(pty.device()) {
    thread = std::jthread([this](const std::stop_token& stop) { run(stop); });
  }

  void run(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      wait();
      const std::string arrived = pty.read();
      const int baud = pty.client_baud();
      std::string out;
      bool gone = false;
      {
        const std::lock_guard lock(mutex);
        advance();
        unit.set_master_baud(baud);
        if (!arrived.empty()) unit.receive(arrived, latest_s);
        pending += unit.transmit(latest_s);
        out.swap(pending);
        gone = unit.line_gone();
      }
      pty.write(out);
      if (gone == pty.plugged()) replug(gone);
    }
  }

  void replug(bool gone) {
    if (gone) {
      pty.unplug();
    } else {
      pty.plug();
    }
    const std::lock_guard lock(mutex);
    device = pty.device();
  }

  // Waits until bytes arrive or the unit has some.
  void wait() {
    double sleep_s = kLongestSleep_s;
    {
      const std::lock_guard lock(mutex);
      if (const auto next_s = unit.next_output_s()) {
        sleep_s = std::clamp(*next_s + kBatch_s - clock_monotonic_s(), 0.0, kLongestSleep_s);
      }
    }
    pty.wait(sleep_s);
  }

  void advance() { latest_s = std::max(latest_s, clock_monotonic_s()); }

  std::mutex mutex;  // for everything but the pty, which only the thread uses
  FaultyPtuUnit unit;
  std::string pending;
  double latest_s = 0.0;
  Pty pty;
  std::string device;
  std::jthread thread;  // last: it uses the rest
};

PtuLine::PtuLine(const PtuUnitConfig& config, std::uint64_t seed, const std::string& link)
    : impl_(std::make_unique<Impl>(config, seed, link)) {}

PtuLine::~PtuLine() = default;

std::string PtuLine::device() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->device;
}

void PtuLine::set_faults(const PtuFaults& faults) {
  const std::lock_guard lock(impl_->mutex);
  impl_->advance();
  impl_->unit.set_faults(faults, impl_->latest_s);
}

PanTilt PtuLine::angles_at(double monotonic_time_s) {
  const std::lock_guard lock(impl_->mutex);
  // The bytes that the unit has received by now take effect first.
  impl_->advance();
  impl_->pending += impl_->unit.transmit(impl_->latest_s);
  return impl_->unit.angles_at(monotonic_time_s);
}

}  // namespace ols::sim
