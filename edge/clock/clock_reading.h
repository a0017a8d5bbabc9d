// Combines the states of kernel and chrony into one reading. Pure.
//
// If chrony runs, its state counts, because without `rtcsync` chrony does not set the kernel's
// flag. Without chrony, the kernel's flag counts: systemd-timesyncd, ntpd and ptp4l/phc2sys
// maintain it. A time service that has run since boot leaves traces in the kernel: a frequency
// correction, an error estimate, an active phase-locked loop.
#pragma once

#include <optional>

#include "edge/clock/chrony_tracking.h"
#include "edge/clock/clock_watch.h"

namespace ols::clock {

// The kernel's clock state, from struct timex (adjtimex(2)).
struct KernelClock {
  bool synchronised = false;  // neither STA_UNSYNC nor TIME_ERROR
  bool loop = false;          // STA_PLL or STA_FLL
  double frequency = 0.0;     // correction of the frequency, relative
  // nullopt if the kernel states 16 s, which means "not known"
  std::optional<double> estimated_error_s, max_error_s;
  int leap_s = 0;
  int tai_minus_utc_s = 0;  // 0 if unknown
};

// `service_seen`: an earlier reading since boot showed a time service.
ClockReading make_clock_reading(const KernelClock& kernel,
                                const std::optional<ChronyTracking>& chrony, bool service_seen);

}  // namespace ols::clock
