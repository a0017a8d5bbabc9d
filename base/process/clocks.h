// The two clocks of a process. Only main programs, and code for devices, sockets and threads, read
// them; pure code is given the time.
#pragma once

#include <cstdint>

#include "base/process/time_source.h"

namespace ols {

inline std::int64_t clock_monotonic_ns() { return time_source().monotonic_ns(); }
inline double clock_monotonic_s() { return 1e-9 * static_cast<double>(clock_monotonic_ns()); }

// UTC [ns] since 1970.
inline std::int64_t clock_utc_ns() { return time_source().utc_ns(); }
inline std::int64_t clock_utime_us() { return clock_utc_ns() / 1000; }

}  // namespace ols
