// Computes the pause before the next attempt to connect to a camera. The pause begins with kFirst_s
// and doubles with each attempt, up to kLongest_s. After a connection that has delivered pictures
// for kHealthy_s, the pause is kFirst_s again. Pure.
#pragma once

#include <algorithm>

namespace ols::camera {

class RetryPause {
 public:
  static constexpr double kFirst_s = 0.5;
  static constexpr double kLongest_s = 30.0;
  static constexpr double kHealthy_s = 10.0;

  // The pause after a connection that has delivered pictures for `delivered_s`.
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
