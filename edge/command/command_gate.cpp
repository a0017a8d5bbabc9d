#include "edge/command/command_gate.h"

#include <algorithm>
#include <cmath>

namespace ols::station {

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
  // In floating point: an invalid stamp must not overflow the difference.
  const double age_s =
      (static_cast<double>(now_utime_us) - static_cast<double>(stamp.utime_us)) * 1e-6;
  if (age_s > stamp.lease_s + config_.clock_margin_s) return GateRefusal::kStale;
  if (age_s < -config_.clock_margin_s) return GateRefusal::kFuture;
  look_at_clock(now_utime_us);
  if (is_replayed(stamp, now_utime_us)) return GateRefusal::kReplayed;
  remember(stamp, now_utime_us);
  return std::nullopt;
}

// A clock that was set back by more than the longest freshness must not block all commands until it
// catches up: what was forgotten may pass once more.
void CommandGate::look_at_clock(std::int64_t now_utime_us) {
  const double back_s =
      (static_cast<double>(latest_utime_us_) - static_cast<double>(now_utime_us)) * 1e-6;
  if (back_s > config_.lease_max_s + config_.clock_margin_s) forgotten_utime_us_.reset();
  latest_utime_us_ = now_utime_us;
}

// An accepted command is either still in the set or not later than the last one forgotten.
bool CommandGate::is_replayed(const CommandStamp& stamp, std::int64_t now_utime_us) const {
  // A clock that was set back since must not block all commands until it catches up.
  if (now_utime_us >= began_utime_us_ && stamp.utime_us < began_utime_us_) return true;
  if (forgotten_utime_us_ && stamp.utime_us <= *forgotten_utime_us_) return true;
  return passed_.contains({stamp.utime_us, stamp.boot_id, stamp.sequence});
}

void CommandGate::remember(const CommandStamp& stamp, std::int64_t now_utime_us) {
  passed_.emplace(stamp.utime_us, stamp.boot_id, stamp.sequence);
  const std::int64_t fresh_utime_us =
      now_utime_us - std::llround((config_.lease_max_s + config_.clock_margin_s) * 1e6);
  while (passed_.size() > config_.kept) {
    const std::int64_t oldest_utime_us = std::get<0>(*passed_.begin());
    if (oldest_utime_us >= fresh_utime_us && passed_.size() <= config_.most) return;
    forgotten_utime_us_ = std::max(forgotten_utime_us_.value_or(oldest_utime_us), oldest_utime_us);
    passed_.erase(passed_.begin());
  }
}

}  // namespace ols::station
