#include "tools/sim/ptu_line.h"

#include <algorithm>
#include <mutex>
#include <stop_token>
#include <thread>

#include "base/clocks.h"
#include "tools/sim/pty.h"

namespace ols::sim {

namespace {

constexpr double kLongestSleep_s = 0.02;  // so that an end is noticed
constexpr double kBatch_s = 1e-3;         // bytes that come within this are handed on together

}  // namespace

struct PtuLine::Impl {
  Impl(const PtuUnitConfig& config, std::uint64_t seed, const std::string& link_path)
      : unit(config, seed, clock_monotonic_s()), pty(link_path), device(pty.device()) {
    thread = std::jthread([this](const std::stop_token& stop) { run(stop); });
  }

  void run(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      wait();
      const std::string arrived = pty.read();
      const double now_s = clock_monotonic_s();
      std::string out;
      {
        const std::lock_guard lock(mutex);
        latest_s = std::max(latest_s, now_s);
        if (!arrived.empty()) unit.receive(arrived, latest_s);
        pending += unit.transmit(latest_s);
        out.swap(pending);
      }
      pty.write(out);
    }
  }

  // Until bytes arrive or the unit has some.
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

  std::mutex mutex;  // of unit, pending, latest_s
  PtuUnit unit;
  std::string pending;
  double latest_s = 0.0;
  Pty pty;  // of the thread
  std::string device;
  std::jthread thread;  // last: it uses the rest
};

PtuLine::PtuLine(const PtuUnitConfig& config, std::uint64_t seed, const std::string& link)
    : impl_(std::make_unique<Impl>(config, seed, link)) {}

PtuLine::~PtuLine() = default;

const std::string& PtuLine::device() const { return impl_->device; }

PanTilt PtuLine::angles_at(double monotonic_time_s) {
  const std::lock_guard lock(impl_->mutex);
  // What the unit has received by now takes effect first.
  impl_->latest_s = std::max(impl_->latest_s, clock_monotonic_s());
  impl_->pending += impl_->unit.transmit(impl_->latest_s);
  return impl_->unit.angles_at(monotonic_time_s);
}

}  // namespace ols::sim
