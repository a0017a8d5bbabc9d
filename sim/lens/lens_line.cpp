#include "sim/lens/lens_line.h"

#include <algorithm>
#include <mutex>
#include <stop_token>
#include <thread>

#include "base/process/clocks.h"
#include "sim/serial/pty.h"

namespace ols::sim {
namespace {

constexpr double kLongestSleep_s = 0.02;  // so that it ends promptly

}  // namespace

struct LensLine::Impl {
  Impl(const LensUnitConfig& config, const std::string& link)
      : unit(config, clock_monotonic_s()), pty(link), device(pty.device()) {
    thread = std::jthread([this](const std::stop_token& stop) { run(stop); });
  }

  void run(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      pty.wait(sleep_s());
      const std::string arrived = pty.read();
      std::string out;
      {
        const std::lock_guard lock(mutex);
        const double now_s = clock_monotonic_s();
        unit.receive(arrived, now_s);
        out = unit.transmit(now_s);
      }
      pty.write(out);
    }
  }

  double sleep_s() {
    const std::lock_guard lock(mutex);
    const auto next_s = unit.next_output_s();
    return next_s ? std::clamp(*next_s - clock_monotonic_s(), 0.0, kLongestSleep_s)
                  : kLongestSleep_s;
  }

  mutable std::mutex mutex;  // of the unit
  LensUnit unit;
  Pty pty;
  std::string device;
  std::jthread thread;  // last: it uses the rest
};

LensLine::LensLine(const LensUnitConfig& config, const std::string& link)
    : impl_(std::make_unique<Impl>(config, link)) {}

LensLine::~LensLine() = default;

const std::string& LensLine::device() const { return impl_->device; }

double LensLine::zoom_at(double monotonic_s) const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->unit.zoom_at(monotonic_s);
}

}  // namespace ols::sim
