// Estimates the accuracy of the station's UTC. Pure: edge/clock/clock_source.h reads kernel and
// chrony. The clock has one of three states:
//
//  - synchronised: a time service states that the clock is synchronised. The error is the service's
//    own estimate.
//  - unsynchronised: a time service has run since boot, but the clock is not synchronised (any
//    more), or there has been no reading for a while. The error grows from its last good value, by
//    the drift of a free-running clock. The state is the same after a step of the clock that no
//    service has confirmed.
//  - unknown: there is no trace of a time service since boot. A person has set the clock, more or
//    less accurately. The error is assumed_sd_s. The fusion checks this assumption by comparing the
//    clocks of the stations.
//
// A step is a jump of CLOCK_REALTIME relative to CLOCK_MONOTONIC. The slow slewing by a service and
// an announced leap second are not steps. A suspend of the computer looks like a step and is
// treated as one, because afterwards the time comes from the battery clock. A service confirms a
// step when it has measured again and states that it is synchronised. Without any service, the
// clock is distrusted for `distrust_s` after a step. After that time, the state is unknown again,
// because the station cannot decide whether the time before or after the step is right.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "conditions/alarm.h"

namespace ols::clock {

// The numerical values are those in the message bearing_t.
enum class ClockState { kUnknown, kSynchronised, kUnsynchronised };

// The state of the time service at one instant, from the kernel (ntp_adjtime) and chrony.
struct ClockReading {
  double monotonic_s = 0.0;
  std::int64_t utime_us = 0;  // CLOCK_REALTIME at the same instant
  bool service = false;       // a time service disciplines the clock, or has done so since boot
  bool synchronised = false;
  std::optional<double> estimated_error_s;  // 1-sigma, stated by the service
  std::optional<double> offset_s;           // from chrony: system clock minus NTP time
  std::string source;                       // "chrony: PPS", "kernel"; empty if there is none
  // UTC of the service's last measurement; a changed value means a new measurement.
  std::optional<double> measured_utc_s;
  int leap_s = 0;  // leap second announced for the end of this day: +1 inserted, -1 deleted, 0 none
  std::optional<int> tai_minus_utc_s;  // as the kernel states it
};

struct ClockQuality {
  ClockState state = ClockState::kUnknown;
  double error_s = 0.0;     // 1-sigma of UTC
  std::uint64_t steps = 0;  // number of steps of CLOCK_REALTIME relative to CLOCK_MONOTONIC
  double last_step_s = 0.0;
  std::string text;                    // the state in words, for people
  Alarm alarm;                         // the present alarm about the clock; empty if there is none
  std::optional<double> offset_s;      // from the last reading
  std::optional<int> tai_minus_utc_s;  // from the last reading
};

class ClockWatch {
 public:
  struct Config {
    double assumed_sd_s = 1e-3;  // 1-sigma of a clock of unknown quality
    // Without any service: how long the clock is distrusted after a step.
    double distrust_s = 60.0;
    double drift_per_s = 2e-5;  // growth of the error of a free-running clock [s per s]
  };
  explicit ClockWatch(const Config& config) : config_(config) {}

  // Call in every cycle of the control loop, so that a step is noticed before the next frame's time
  // is computed. Both clocks must be read at one instant, as by read_clock_pair().
  void tick(double monotonic_s, std::int64_t utime_us);
  // Call for each reading of the time service.
  void add(const ClockReading& reading);

  ClockQuality quality(double monotonic_s) const;

 private:
  struct Step {
    double time_s;  // time of the last unconfirmed step
    double sum_s;   // sum of all unconfirmed steps
    // The service's last measurement before the first of these steps.
    std::optional<double> measured_utc_s;
  };
  // The last reading of a synchronised service.
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
  std::optional<Step> step_;  // set while there are unconfirmed steps
  double last_step_s_ = 0.0;
  std::uint64_t steps_ = 0;
};

}  // namespace ols::clock
