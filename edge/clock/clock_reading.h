// From what kernel and chrony say to one reading. Pure.
//
// chrony's word goes first: without `rtcsync` the kernel does not learn from it. Without chrony the
// kernel's own flag counts, which systemd-timesyncd, ntpd and ptp4l/phc2sys keep. "A service was
// there in this boot" is known by its traces in the kernel: a frequency correction, an error
// estimate, a phase-locked loop that is on.
#pragma once

#include <optional>

#include "edge/clock/chrony_tracking.h"
#include "edge/clock/clock_watch.h"

namespace ols {

// Of struct timex (adjtimex(2)).
struct KernelClock {
  bool synchronised = false;                                  // neither STA_UNSYNC nor TIME_ERROR
  bool loop = false;                                          // STA_PLL or STA_FLL
  double frequency = 0.0;                                     // correction, parts of one
  std::optional<double> estimated_error_s, greatest_error_s;  // nothing: 16 s, "not known"
  int leap_s = 0;
  int tai_minus_utc_s = 0;  // 0: not known
};

// `service_seen`: in an earlier reading of this boot.
ClockReading make_clock_reading(const KernelClock& kernel,
                                const std::optional<ChronyTracking>& chrony, bool service_seen);

}  // namespace ols
