// Applies a rate limit to each channel separately. If there are too many channels, forgets those
// that were silent for a minute. Pure.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "base/trust/rate_limit.h"

namespace ols::bridge {

class ChannelRateLimits {
 public:
  static constexpr double kSilent_s = 60.0;

  explicit ChannelRateLimits(std::size_t most) : most_(most) {}

  // Whether one more message may pass now; if so, counts it.
  bool passes(std::string_view channel, double rate_hz, double now_s);

 private:
  static constexpr double kSweep_s = 1.0;  // shortest time between two searches for silent
                                           // channels, even if new names arrive faster

  struct One {
    trust::RateLimit limit;
    double heard_s = 0.0;
  };

  std::size_t most_;
  std::map<std::string, One, std::less<>> channels_;
  double swept_s_ = -1e9;
};

}  // namespace ols::bridge
