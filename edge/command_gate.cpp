#include "edge/command_gate.h"

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
  if (last_) {
    const bool same_boot = stamp.boot_id == last_->boot_id;
    // Another boot is a restarted sender only when it is the later one.
    const bool later =
        same_boot ? stamp.sequence > last_->sequence : stamp.utime_us > last_->utime_us;
    if (!later) return GateRefusal::kReplayed;
  }
  last_ = stamp;
  return std::nullopt;
}

}  // namespace ols
