// The two clocks of a process. Only main programs and device code read them.
#pragma once

#include <cstdint>
#include <ctime>

namespace ols {

inline double clock_monotonic_s() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

// UTC since 1970 [us].
inline std::int64_t clock_utime_us() {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  return static_cast<std::int64_t>(now.tv_sec) * 1'000'000 + now.tv_nsec / 1000;
}

}  // namespace ols
