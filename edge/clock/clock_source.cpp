#include "edge/clock/clock_source.h"

#include <sys/timex.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <thread>
#include <utility>

#include "base/process/command_output.h"
#include "edge/clock/chrony_tracking.h"
#include "edge/clock/clock_pair.h"
#include "edge/clock/clock_reading.h"

namespace ols::clock {
namespace {

constexpr double kChrony_s = 2.0;              // chronyc tries three addresses
constexpr long kUnknownError_us = 16'000'000;  // NTP_PHASE_LIMIT: what the kernel starts with

std::optional<double> error_s(long error_us) {
  if (error_us < 0 || error_us >= kUnknownError_us) return std::nullopt;
  return 1e-6 * static_cast<double>(error_us);
}

// Only reads: modes is 0.
KernelClock read_kernel() {
  timex kernel{};
  const int state = ::ntp_adjtime(&kernel);
  KernelClock clock;
  if (state < 0) return clock;
  clock.synchronised = state != TIME_ERROR && (kernel.status & STA_UNSYNC) == 0;
  clock.loop = (kernel.status & (STA_PLL | STA_FLL)) != 0;
  clock.frequency = static_cast<double>(kernel.freq) / 65536.0 * 1e-6;  // ppm, 16 fraction bits
  clock.estimated_error_s = error_s(kernel.esterror);
  clock.max_error_s = error_s(kernel.maxerror);
  if ((kernel.status & STA_INS) != 0) clock.leap_s = 1;
  if ((kernel.status & STA_DEL) != 0) clock.leap_s = -1;
  clock.tai_minus_utc_s = kernel.tai;
  return clock;
}

}  // namespace

struct ClockSource::Impl {
  Impl(double reading_interval_s, std::vector<std::string> command)
      : interval_s(reading_interval_s), chronyc(std::move(command)) {}

  void run(const std::stop_token& ended) {
    bool service_seen = false;
    while (!ended.stop_requested()) {
      // The instant before the query: the answer is not older.
      const ClockPair now = read_clock_pair();
      const auto answer = command_output(chronyc, kChrony_s);
      ClockReading reading = make_clock_reading(
          read_kernel(), answer ? parse_chrony_tracking(*answer) : std::nullopt, service_seen);
      reading.monotonic_s = now.monotonic_s;
      reading.utime_us = now.utime_us;
      service_seen = reading.service;
      std::unique_lock lock(mutex);
      newest = std::move(reading);
      wake.wait_for(lock, ended, std::chrono::duration<double>(interval_s), [] { return false; });
    }
  }

  const double interval_s;
  const std::vector<std::string> chronyc;
  std::mutex mutex;  // of everything below
  std::condition_variable_any wake;
  std::optional<ClockReading> newest;
  std::jthread thread;  // last: it uses the rest
};

ClockSource::ClockSource(double interval_s, std::vector<std::string> chronyc)
    : impl_(std::make_unique<Impl>(interval_s, std::move(chronyc))) {
  impl_->thread = std::jthread([impl = impl_.get()](const std::stop_token& t) { impl->run(t); });
}

ClockSource::~ClockSource() = default;  // the jthread asks to stop and joins

std::optional<ClockReading> ClockSource::take() {
  const std::lock_guard lock(impl_->mutex);
  return std::exchange(impl_->newest, std::nullopt);
}

}  // namespace ols::clock
