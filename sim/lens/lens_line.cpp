#include "sim/lens/lens_line.h"

#include <algorithm>

#include "base/process/clocks.h"

namespace ols::sim {
namespace {

constexpr double kLongestSleep_s = 0.02;  // so that it ends promptly

}  // namespace

LensLine::LensLine(const LensUnitConfig& config, const std::string& link)
    : unit_(config, clock_monotonic_s()),
      pty_(link),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

void LensLine::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    pty_.wait(sleep_s());
    const std::string arrived = pty_.read();
    std::string out;
    {
      const std::lock_guard lock(mutex_);
      const double now_s = clock_monotonic_s();
      unit_.receive(arrived, now_s);
      out = unit_.transmit(now_s);
    }
    pty_.write(out);
  }
}

double LensLine::sleep_s() const {
  const std::lock_guard lock(mutex_);
  const auto next_s = unit_.next_output_s();
  return next_s ? std::clamp(*next_s - clock_monotonic_s(), 0.0, kLongestSleep_s) : kLongestSleep_s;
}

double LensLine::zoom_at(double monotonic_s) const {
  const std::lock_guard lock(mutex_);
  return unit_.zoom_at(monotonic_s);
}

}  // namespace ols::sim
