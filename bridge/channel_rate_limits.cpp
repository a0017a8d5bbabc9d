#include "bridge/channel_rate_limits.h"

namespace ols::bridge {

bool ChannelRateLimits::passes(std::string_view channel, double rate_hz, double now_s) {
  auto at = channels_.find(channel);
  if (at == channels_.end()) {
    if (channels_.size() >= most_ && now_s - swept_s_ >= kSweep_s) {
      swept_s_ = now_s;
      std::erase_if(channels_,
                    [now_s](const auto& one) { return now_s - one.second.heard_s >= kSilent_s; });
    }
    if (channels_.size() >= most_) return false;
    at = channels_.emplace(std::string(channel), One{trust::RateLimit(rate_hz)}).first;
  }
  at->second.heard_s = now_s;
  if (!at->second.limit.has(now_s)) return false;
  at->second.limit.spend();
  return true;
}

}  // namespace ols::bridge
