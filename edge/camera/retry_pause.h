// Determines how long to wait before a camera is connected again. Pure.
#pragma once

#include <algorithm>

namespace ols::camera {

class RetryPause {
 public:
  static constexpr double kFirst_s = 0.5;
  static constexpr double kLongest_s = 30.0;
  static constexpr double kHealthy_s = 10.0;

  // The pause after a stream that delivered pictures for this time.
  double after_stream(double delivered_s) {
    if (delivered_s >= kHealthy_s) next_s_ = kFirst_s;
    const double pause_s = next_s_;
    next_s_ = std::min(kLongest_s, 2.0 * next_s_);
    return pause_s;
  }

 private:
  double next_s_ = kFirst_s;
};

}  // namespace ols::camera
