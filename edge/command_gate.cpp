#include "edge/command_gate.h"

#include <algorithm>
#include <cmath>

namespace ols {

const char* to_string(GateRefusal refusal) {
  switch (refusal) {
    case GateRefusal::kStale:
      return "stale";
    case GateRefusal::kFuture:
      return "from_the_future";
    case GateRefusal::kReplayed:
      return "replayed";
    case GateRefusal::kLease:
      return "lease";
  }
  return "unknown";
}

std::optional<GateRefusal> CommandGate::admit(const CommandStamp& stamp,
                                              std::int64_t now_utime_us) {
  if (!std::isfinite(stamp.lease_s) || stamp.lease_s <= 0.0 ||
      stamp.lease_s > config_.lease_max_s) {
    return GateRefusal::kLease;
  }
  // In floating point: an absurd stamp must not overflow the difference.
  const double age_s =
      (static_cast<double>(now_utime_us) - static_cast<double>(stamp.utime_us)) * 1e-6;
  if (age_s > stamp.lease_s + config_.clock_margin_s) return GateRefusal::kStale;
  if (age_s < -config_.clock_margin_s) return GateRefusal::kFuture;
  if (is_replayed(stamp, now_utime_us)) return GateRefusal::kReplayed;
  remember(stamp);
  return std::nullopt;
}

// Whatever was let through is found here again: by its boot's sequence, which only grows, or, where
// its boot is forgotten, by its time. Neither asks for the time it is now.
bool CommandGate::is_replayed(const CommandStamp& stamp, std::int64_t now_utime_us) const {
  // A clock that was set back since must not bar everybody until it gets there again.
  if (now_utime_us >= began_utime_us_ && stamp.utime_us < began_utime_us_) return true;
  if (forgotten_utime_us_ && stamp.utime_us <= *forgotten_utime_us_) return true;
  const auto known = std::ranges::find(senders_, stamp.boot_id, &Sender::boot_id);
  if (known != senders_.end() && stamp.sequence <= known->sequence) return true;
  if (known != senders_.end() && known == senders_.end() - 1) return false;
  // Another boot is a restarted sender only when it is the later one; of those whose time can have
  // been: what came while a clock was fast would bar everybody until that time is reached.
  const double latest_us = static_cast<double>(now_utime_us) + config_.clock_margin_s * 1e6;
  return std::ranges::any_of(senders_, [&](const Sender& other) {
    return static_cast<double>(other.utime_us) <= latest_us && stamp.utime_us <= other.utime_us;
  });
}

void CommandGate::remember(const CommandStamp& stamp) {
  Sender sender{stamp.boot_id, stamp.sequence, stamp.utime_us, stamp.utime_us};
  const auto known = std::ranges::find(senders_, stamp.boot_id, &Sender::boot_id);
  if (known != senders_.end()) {
    sender.latest_utime_us = std::max(sender.latest_utime_us, known->latest_utime_us);
    senders_.erase(known);
  }
  senders_.push_back(sender);
  if (senders_.size() <= kMostSenders) return;
  const std::int64_t gone_utime_us = senders_.front().latest_utime_us;
  forgotten_utime_us_ = std::max(forgotten_utime_us_.value_or(gone_utime_us), gone_utime_us);
  senders_.pop_front();
}

}  // namespace ols
