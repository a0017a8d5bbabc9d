#include "edge/command_judgement.h"

#include <cmath>

#include "geometry/angles.h"
#include "geometry/slew_limits.h"

namespace ols::station {
namespace {

bool finite(const PanTilt& angles) {
  return std::isfinite(angles.pan_rad) && std::isfinite(angles.tilt_rad);
}

bool finite(const SlewCommand& slew) {
  for (const double value :
       {slew.effect_s, slew.received_s, slew.lease_s, slew.direction.azimuth_rad,
        slew.direction.elevation_rad, slew.azimuth_rate_rad_s, slew.elevation_rate_rad_s,
        slew.direction_sd_rad}) {
    if (!std::isfinite(value)) return false;
  }
  return true;
}

bool finite(const DesignateCommand& command) {
  for (const double value : {command.frame_time_s.value_or(0.0), command.box.x, command.box.y,
                             command.box.width, command.box.height}) {
    if (!std::isfinite(value)) return false;
  }
  return true;
}

bool in_range(const PanTilt& angles) {
  return std::abs(angles.pan_rad) <= kPointPanLimit_rad &&
         std::abs(angles.tilt_rad) <= kPointTiltLimit_rad;
}

bool in_range(const SlewCommand& command, double now_s, double lease_max_s) {
  return command.lease_s > 0.0 && command.lease_s <= lease_max_s &&
         std::abs(command.effect_s - now_s) <= kSlewLead_s &&
         std::abs(command.direction.azimuth_rad) <= 2.0 * kPi &&
         std::abs(command.direction.elevation_rad) <= kPi / 2.0 &&
         std::abs(command.azimuth_rate_rad_s) <= kSlewRateLimit_rad_s &&
         std::abs(command.elevation_rate_rad_s) <= kSlewRateLimit_rad_s &&
         command.direction_sd_rad >= 0.0 && command.direction_sd_rad <= kPi;
}

}  // namespace

Refusal judge(const DesignateCommand& command, const Situation& situation) {
  const Refusal refusal = situation.mode.refuses_operator(situation.now_s);
  if (refusal != Refusal::kNone) return refusal;
  return finite(command) ? Refusal::kNone : Refusal::kNotFinite;
}

Refusal judge(const SlewCommand& command, const Situation& situation) {
  const StationMode& mode = situation.mode;
  if (mode.is(StationState::kEmergency)) return Refusal::kEmergency;
  if (!finite(command)) return Refusal::kNotFinite;
  if (!in_range(command, situation.now_s, situation.config.slew_lease_max_s)) {
    return Refusal::kOutOfRange;
  }
  if (mode.is(StationState::kManual) || mode.is(StationState::kStopped)) {
    return Refusal::kPrecedence;
  }
  if (mode.has_doubtful_angles()) return Refusal::kNoReference;
  // On the whole way that this one command can cover, not only at its end.
  for (const double time_s :
       {situation.now_s, command.effect_s, command.received_s + command.lease_s}) {
    if (!situation.pointing.aim(direction_at(command, time_s))) return Refusal::kUnreachable;
  }
  return Refusal::kNone;
}

Refusal judge(const PointCommand& command, const Situation& situation) {
  const StationMode& mode = situation.mode;
  const Refusal refusal = mode.refuses_operator(situation.now_s);
  if (refusal != Refusal::kNone) return refusal;
  if (!finite(command.angles)) return Refusal::kNotFinite;
  if (!in_range(command.angles)) return Refusal::kOutOfRange;
  // A unit that appears later would move unexpectedly.
  if (mode.reference() == ptu::PtuReference::kUnknown) return Refusal::kNoUnit;
  if (mode.has_doubtful_angles()) return Refusal::kNoReference;
  return Refusal::kNone;
}

Refusal judge_home(const Situation& situation) {
  const Refusal refusal = situation.mode.refuses_operator(situation.now_s);
  if (refusal != Refusal::kNone) return refusal;
  if (!situation.config.homing_allowed) return Refusal::kKeepOut;
  if (situation.mode.reference() == ptu::PtuReference::kUnknown) return Refusal::kNoUnit;
  return Refusal::kNone;
}

Refusal judge_reference_ok(const Situation& situation) {
  const StationMode& mode = situation.mode;
  if (mode.is(StationState::kEmergency)) return Refusal::kEmergency;
  if (mode.reference() == ptu::PtuReference::kMissing) return Refusal::kNoReference;
  if (mode.reference() != ptu::PtuReference::kDoubted) return Refusal::kNoDoubt;
  return Refusal::kNone;
}

Refusal judge_rearm(const Situation& situation) {
  return situation.mode.is_pressed() ? Refusal::kEmergency : Refusal::kNone;
}

Refusal judge_rearm_over_bus(const Situation& situation) {
  const Refusal refusal = judge_rearm(situation);
  if (refusal != Refusal::kNone) return refusal;
  return situation.config.rearm_over_bus ? Refusal::kNone : Refusal::kRearmNeedsAHand;
}

}  // namespace ols::station
