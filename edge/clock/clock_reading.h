// Combines the states of the kernel's clock and of chrony into one reading. Pure.
//
// If chrony runs, the reading is chrony's state: without `rtcsync`, chrony does not set the
// kernel's flag "synchronised". Without chrony, the reading is the kernel's state:
// systemd-timesyncd, ntpd and ptp4l/phc2sys maintain the flag. A time service that has ended is
// recognised by its traces in the kernel: a frequency correction, an error estimate or an active
// phase-locked loop.
#pragma once

#include <optional>

#include "edge/clock/chrony_tracking.h"
#include "edge/clock/clock_watch.h"

namespace ols::clock {

// The kernel's clock state, from struct timex (adjtimex(2)).
struct KernelClock {
  bool synchronised = false;  // neither STA_UNSYNC nor TIME_ERROR
  bool loop = false;          // STA_PLL or STA_FLL
  double frequency = 0.0;     // relative correction of the clock's frequency
  // nullopt if the kernel states 16 s, which means "unknown"
  std::optional<double> estimated_error_s, max_error_s;
  int leap_s = 0;
  int tai_minus_utc_s = 0;  // 0 if unknown
};

// `service_seen`: whether an earlier reading since boot has shown a time service.
ClockReading make_clock_reading(const KernelClock& kernel,
                                const std::optional<ChronyTracking>& chrony, bool service_seen);

}  // namespace ols::clock
