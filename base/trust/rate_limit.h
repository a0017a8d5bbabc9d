// A token bucket: lets `rate_hz` messages per second pass on average, in bursts of at most one
// second's worth. Pure.
#pragma once

#include <algorithm>

namespace ols::trust {

class RateLimit {
 public:
  explicit RateLimit(double rate_hz) : rate_hz_(rate_hz), tokens_(rate_hz) {}

  // Whether one more message may pass now. If it passes, call spend(). `now_s`: monotonic.
  bool has(double now_s) {
    if (seen_s_ >= 0.0) {
      tokens_ = std::min(rate_hz_, tokens_ + std::max(0.0, now_s - seen_s_) * rate_hz_);
    }
    seen_s_ = now_s;
    return tokens_ >= 1.0;
  }
  void spend() { tokens_ -= 1.0; }

 private:
  double rate_hz_;
  double tokens_;
  double seen_s_ = -1.0;
};

}  // namespace ols::trust
