#include "edge/clock/clock_watch.h"

#include <algorithm>
#include <cmath>

#include "conditions/alarms.h"
#include "conditions/printed.h"

namespace ols::clock {
namespace {

constexpr std::int64_t kDay_us = 86'400'000'000;
constexpr double kLeapTolerance_s = 0.05;
constexpr double kLeapAround_s = 5.0;  // of midnight
constexpr double kMaxSlew_s = 0.5;
constexpr double kStep_s = 0.05;         // a greater jump between two calls is a step
constexpr double kSlewPerSecond = 1e-3;  // the service may steer this much: not a step
constexpr double kNeverSetSd_s = 1.0;    // 1-sigma of a battery clock, never synchronised
constexpr double kSilence_s = 30.0;      // without a reading the clock counts as free-running
// Minimum difference in date between two measurements.
constexpr double kNewMeasurement_s = 1e-3;

// "12 us", "3.4 ms", "2.00 s"
std::string format(double seconds) {
  if (seconds < 1e-3) return printed("%.0f us", seconds * 1e6);
  if (seconds < 1.0) return printed("%.1f ms", seconds * 1e3);
  return printed("%.2f s", seconds);
}

ClockQuality alarmed(ClockQuality quality, const Alarm& alarm) {
  quality.text = alarm.reason();
  quality.alarm = alarm;
  return quality;
}

}  // namespace

void ClockWatch::tick(double monotonic_s, std::int64_t utime_us) {
  const std::int64_t offset_us = utime_us - std::llround(monotonic_s * 1e6);
  if (offset_us_) {
    const double jump_s = 1e-6 * static_cast<double>(offset_us - *offset_us_);
    const double slew_s = kSlewPerSecond * std::max(0.0, monotonic_s - tick_s_);
    if (std::abs(jump_s) > kStep_s + std::min(slew_s, kMaxSlew_s) &&
        !is_leap_second(jump_s, utime_us)) {
      ++steps_;
      last_step_s_ = jump_s;
      if (!step_) {
        step_ = Step{monotonic_s, 0.0, reading_ ? reading_->measured_utc_s : std::nullopt};
      }
      step_->time_s = monotonic_s;
      step_->sum_s += jump_s;
    }
  }
  offset_us_ = offset_us;
  tick_s_ = monotonic_s;
}

// The kernel sets the clock back by a second at the end of an inserted one, at midnight UTC.
bool ClockWatch::is_leap_second(double jump_s, std::int64_t utime_us) const {
  if (!reading_ || reading_->leap_s == 0) return false;
  if (std::abs(jump_s + reading_->leap_s) > kLeapTolerance_s) return false;
  const auto since_midnight_us = static_cast<double>(((utime_us % kDay_us) + kDay_us) % kDay_us);
  const double from_midnight_s =
      1e-6 * std::min(since_midnight_us, static_cast<double>(kDay_us) - since_midnight_us);
  return from_midnight_s < kLeapAround_s;
}

void ClockWatch::add(const ClockReading& reading) {
  reading_ = reading;
  if (step_ && reading.monotonic_s > step_->time_s && confirms(reading)) step_.reset();
  if (!step_ && reading.synchronised) {
    good_ = Good{reading.monotonic_s, reading.estimated_error_s.value_or(config_.assumed_sd_s)};
  }
}

// The kernel clears its synchronised flag when the clock is set (ntp_clear), but chronyd
// notices it only at its next measurement.
bool ClockWatch::confirms(const ClockReading& reading) const {
  if (!reading.synchronised) return false;
  if (!reading.measured_utc_s || !step_->measured_utc_s) return true;
  return std::abs(*reading.measured_utc_s - *step_->measured_utc_s) > kNewMeasurement_s;
}

// As if there had been no step.
ClockQuality ClockWatch::unstepped(double monotonic_s) const {
  ClockQuality quality;
  const bool service = reading_ && reading_->service;
  if (!service && !good_) {
    quality.error_s = config_.assumed_sd_s;
    quality.text = "no time service, taken as good to " + format(quality.error_s);
    return quality;
  }
  if (!good_) {
    quality.state = ClockState::kUnsynchronised;
    quality.error_s = kNeverSetSd_s;
    return alarmed(quality, alarm::clock_not_synchronised(reading_->source));
  }
  const double age_s = std::max(0.0, monotonic_s - good_->time_s);
  const bool silent = monotonic_s - reading_->monotonic_s > kSilence_s;
  if (reading_->synchronised && !silent) {
    quality.state = ClockState::kSynchronised;
    quality.error_s = good_->error_s;
    quality.text = "synchronised by " + reading_->source + ", " + format(quality.error_s);
    return quality;
  }
  quality.state = ClockState::kUnsynchronised;
  quality.error_s = std::hypot(good_->error_s, config_.drift_per_s * age_s);
  return alarmed(quality, alarm::clock_lost(age_s, format(quality.error_s)));
}

ClockQuality ClockWatch::quality(double monotonic_s) const {
  ClockQuality quality = unstepped(monotonic_s);
  quality.steps = steps_;
  quality.last_step_s = last_step_s_;
  if (reading_) {
    quality.offset_s = reading_->offset_s;
    quality.tai_minus_utc_s = reading_->tai_minus_utc_s;
  }
  if (!step_) return quality;
  const double ago_s = std::max(0.0, monotonic_s - step_->time_s);
  const bool service = reading_ && reading_->service;
  if (!service && !good_ && ago_s > config_.distrust_s) return quality;
  quality.state = ClockState::kUnsynchronised;
  // Steps that cancel leave the clock as it was.
  quality.error_s = std::hypot(quality.error_s, step_->sum_s);
  return alarmed(quality, alarm::clock_stepped(last_step_s_, ago_s));
}

}  // namespace ols::clock
