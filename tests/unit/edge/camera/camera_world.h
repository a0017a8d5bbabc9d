// A simulated clock of a camera, for tests of the time base.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "edge/camera/clock_map.h"

namespace ols::camera {

// A camera's clock with a constant offset and a wrong rate, read over a network with random delays.
struct CameraWorld {
  double start_s = 5000.0;  // monotonic
  std::int64_t start_ns = 1'700'000'000'000'000'000;
  double rate_error = 50e-6;  // > 0: the camera's clock is slow
  std::mt19937_64 random{1};

  std::int64_t device_ns(double time_s) const {
    return start_ns + std::llround(1e9 * (time_s - start_s) / (1.0 + rate_error));
  }
  // Reads the clock. Each direction takes 50 us and an exponentially distributed extra time.
  LatchSample latch(double time_s, double mean_extra_s = 100e-6) {
    std::exponential_distribution<double> extra(1.0 / mean_extra_s);
    const double there_s = 50e-6 + extra(random), back_s = 50e-6 + extra(random);
    return {.device_ns = device_ns(time_s + there_s),
            .before_s = time_s,
            .after_s = time_s + there_s + back_s};
  }
};

}  // namespace ols::camera
