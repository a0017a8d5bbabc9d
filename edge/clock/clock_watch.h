// How good the station's UTC is. Pure: kernel and chrony are read by edge/clock/clock_source.h.
//
//   synchronised    a time service says so; the error is the service's own estimate
//   unsynchronised  a time service is or was there in this boot and says that it is not (or no
//                   longer) synchronised, or nothing has been heard of it for a while: the error
//                   grows from the last good one by the drift of a free-running clock; or the
//                   clock was stepped and no service has confirmed the new time
//   unknown         no trace of a time service in this boot: somebody set the clock, well or badly.
//                   The error is the one assumed by the configuration; the fusion compares stations
//
// A step is a jump of CLOCK_REALTIME against CLOCK_MONOTONIC. Slewing by the service is none (it is
// slow), nor is a leap second that was announced. A suspended machine looks like a step, and is as
// good as one: its time comes from the battery clock. A step is confirmed when the service has
// measured since then and is synchronised. Without any service it is distrusted for `distrust_s`:
// whether the old or the new time was right nobody here can say, so that it becomes unknown again,
// not wrong for ever.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace ols {

enum class ClockState { kUnknown, kSynchronised, kUnsynchronised };

// What the kernel (ntp_adjtime) and chrony say at one moment.
struct ClockReading {
  double monotonic_s = 0.0;
  std::int64_t utime_us = 0;  // the same instant by CLOCK_REALTIME
  bool service = false;       // a time service disciplines the clock, or did in this boot
  bool synchronised = false;
  std::optional<double> estimated_error_s;  // 1-sigma as the service has it
  std::optional<double> offset_s;           // chrony: system clock minus NTP time
  std::string source;                       // "chrony: PPS", "kernel"; empty: none
  // The service's last measurement, UTC as it wrote it down: a change tells of a new one.
  std::optional<double> measured_utc_s;
  int leap_s = 0;                      // announced for the end of this day: +1, -1
  std::optional<int> tai_minus_utc_s;  // as the kernel has it
};

struct ClockQuality {
  ClockState state = ClockState::kUnknown;
  double error_s = 0.0;     // 1-sigma of UTC
  std::uint64_t steps = 0;  // of CLOCK_REALTIME against CLOCK_MONOTONIC
  double last_step_s = 0.0;
  std::string text;   // in words
  std::string alarm;  // a condition that holds now: "clock: stepped by ..."; empty: none
  std::optional<double> offset_s;      // of the last reading
  std::optional<int> tai_minus_utc_s;  // of the last reading
};

class ClockWatch {
 public:
  struct Config {
    double assumed_sd_s = 1e-3;  // of a clock of unknown quality
    double distrust_s = 60.0;    // after a step without a service that confirms the new time
    double drift_per_s = 2e-5;   // of a free-running clock: the error grows
  };
  explicit ClockWatch(const Config& config) : config_(config) {}

  // Often (each turn of the control loop): both clocks, so that no frame is stamped across a step.
  // They must be of one instant: edge/clock/clock_pair.h reads them so.
  void tick(double monotonic_s, std::int64_t utime_us);
  // Now and then: what the time service says.
  void add(const ClockReading& reading);

  ClockQuality quality(double monotonic_s) const;

 private:
  struct Step {
    double time_s;                         // of the last one that is not confirmed
    double sum_s;                          // of all that are not confirmed
    std::optional<double> measured_utc_s;  // the service's last measurement before the first
  };
  // The last word of a service that was synchronised.
  struct Good {
    double time_s;
    double error_s;
  };

  bool is_leap_second(double jump_s, std::int64_t utime_us) const;
  bool confirms(const ClockReading& reading) const;
  ClockQuality unstepped(double monotonic_s) const;

  Config config_;
  std::optional<std::int64_t> offset_us_;  // UTC minus monotonic at the last tick
  double tick_s_ = 0.0;
  std::optional<ClockReading> reading_;
  std::optional<Good> good_;
  std::optional<Step> step_;  // not confirmed
  double last_step_s_ = 0.0;
  std::uint64_t steps_ = 0;
};

}  // namespace ols
