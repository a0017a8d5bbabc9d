// A camera's clock as a network shows it, for tests of the time base.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "edge/camera/clock_map.h"

namespace ols::camera {

// A camera's clock that is off by a constant and a rate, read over a network that takes its time.
struct CameraWorld {
  double start_s = 5000.0;  // monotonic
  std::int64_t start_ns = 1'700'000'000'000'000'000;
  double rate_error = 50e-6;  // > 0: the camera's clock is slow
  std::mt19937_64 random{1};

  std::int64_t device_ns(double time_s) const {
    return start_ns + std::llround(1e9 * (time_s - start_s) / (1.0 + rate_error));
  }
  // The way there and back take 50 us and an exponential time more, each.
  LatchSample latch(double time_s, double mean_extra_s = 100e-6) {
    std::exponential_distribution<double> extra(1.0 / mean_extra_s);
    const double there_s = 50e-6 + extra(random), back_s = 50e-6 + extra(random);
    return {.device_ns = device_ns(time_s + there_s),
            .before_s = time_s,
            .after_s = time_s + there_s + back_s};
  }
};

}  // namespace ols::camera
