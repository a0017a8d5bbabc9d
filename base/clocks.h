// The two clocks of a process. Only main programs and device code read them.
#pragma once

#include <cstdint>
#include <ctime>

namespace ols {

namespace detail {

inline std::int64_t clock_ns(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

}  // namespace detail

inline std::int64_t clock_monotonic_ns() { return detail::clock_ns(CLOCK_MONOTONIC); }
inline double clock_monotonic_s() { return 1e-9 * static_cast<double>(clock_monotonic_ns()); }

// UTC since 1970 by this host's clock.
inline std::int64_t clock_utc_ns() { return detail::clock_ns(CLOCK_REALTIME); }
inline std::int64_t clock_utime_us() { return clock_utc_ns() / 1000; }

}  // namespace ols
