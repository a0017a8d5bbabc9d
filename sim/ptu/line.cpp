#include "sim/ptu/line.h"

#include <algorithm>

#include "base/process/clocks.h"

namespace ols::sim {

namespace {

constexpr double kLongestSleep_s = 0.02;  // so that it ends promptly
constexpr double kBatch_s = 1e-3;         // bytes within this time are passed on together

}  // namespace

PtuLine::PtuLine(const PtuUnitConfig& config, std::uint64_t seed, const std::string& link)
    : unit_(config, seed, clock_monotonic_s()),
      pty_(link),
      device_(pty_.device()),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

void PtuLine::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    wait();
    const std::string arrived = pty_.read();
    const int baud = pty_.client_baud();
    std::string out;
    bool gone = false;
    {
      const std::lock_guard lock(mutex_);
      advance();
      unit_.set_master_baud(baud);
      if (!arrived.empty()) unit_.receive(arrived, latest_s_);
      pending_ += unit_.transmit(latest_s_);
      out.swap(pending_);
      gone = unit_.line_gone();
    }
    pty_.write(out);
    if (gone == pty_.plugged()) replug(gone);
  }
}

void PtuLine::wait() {
  double sleep_s = kLongestSleep_s;
  {
    const std::lock_guard lock(mutex_);
    if (const auto next_s = unit_.next_output_s()) {
      sleep_s = std::clamp(*next_s + kBatch_s - clock_monotonic_s(), 0.0, kLongestSleep_s);
    }
  }
  pty_.wait(sleep_s);
}

void PtuLine::replug(bool gone) {
  if (gone) {
    pty_.unplug();
  } else {
    pty_.plug();
  }
  const std::lock_guard lock(mutex_);
  device_ = pty_.device();
}

void PtuLine::advance() { latest_s_ = std::max(latest_s_, clock_monotonic_s()); }

std::string PtuLine::device() const {
  const std::lock_guard lock(mutex_);
  return device_;
}

void PtuLine::set_faults(const PtuFaults& faults) {
  const std::lock_guard lock(mutex_);
  advance();
  unit_.set_faults(faults, latest_s_);
}

PanTilt PtuLine::angles_at(double monotonic_time_s) {
  const std::lock_guard lock(mutex_);
  // The bytes that the unit has received by now take effect first.
  advance();
  pending_ += unit_.transmit(latest_s_);
  return unit_.angles_at(monotonic_time_s);
}

}  // namespace ols::sim
