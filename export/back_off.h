// How long to wait before the next attempt to reach a receiver. The time grows with each failure.
// Pure.
#pragma once

#include <algorithm>

namespace ols::exports {

class BackOff {
 public:
  // Returns the time to wait [s]: 0.25, 0.5, 1, 2, 2, ...
  double after_failure() {
    const double wait_s = next_s_;
    next_s_ = std::min(2.0 * next_s_, kLongest_s);
    return wait_s;
  }
  void after_success() { next_s_ = kShortest_s; }

  static constexpr double kShortest_s = 0.25, kLongest_s = 2.0;

 private:
  double next_s_ = kShortest_s;
};

}  // namespace ols::exports
