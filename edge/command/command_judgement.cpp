#include "edge/command/command_judgement.h"

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
        slew.direction_sd_rad, slew.line.x(), slew.line.y()}) {
    if (!std::isfinite(value)) return false;
  }
  return true;
}

bool finite(const OcclusionCommand& command) {
  const auto exit = command.exit.value_or(OcclusionCommand::Exit{});
  for (const double value :
       {command.made_s, command.holds_s, exit.time_s, exit.sd_s, exit.direction.azimuth_rad,
        exit.direction.elevation_rad, exit.direction_sd_rad}) {
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

bool finite(const RateCommand& command) {
  return finite(command.rate) && std::isfinite(command.lease_s) &&
         std::isfinite(command.received_s);
}

Refusal judge_values(const LensCommand& command) {
  if (!std::isfinite(command.lease_s)) return Refusal::kNotFinite;
  if (command.is_rate && !(command.lease_s > 0.0 && command.lease_s <= kRateLease_s)) {
    return Refusal::kOutOfRange;
  }
  for (const lens::Axis axis : lens::kAxes) {
    const auto& value = command.values[axis];
    if (!value) continue;
    if (!std::isfinite(*value)) return Refusal::kNotFinite;
    if (*value > 1.0 || *value < (command.is_rate ? -1.0 : 0.0)) return Refusal::kOutOfRange;
  }
  return Refusal::kNone;
}

bool in_range(const RateCommand& command) {
  return std::abs(command.rate.pan_rad) <= kRateLimit_rad_s &&
         std::abs(command.rate.tilt_rad) <= kRateLimit_rad_s && command.lease_s > 0.0 &&
         command.lease_s <= kRateLease_s;
}

// Also of a unit that appears later: it would move unexpectedly.
Refusal refuses_motion(const Situation& situation) {
  const StationMode& mode = situation.mode;
  if (!situation.config.moves) return Refusal::kFixedMount;
  if (mode.reference() == mount::Reference::kUnknown) return Refusal::kNoUnit;
  return mode.has_doubtful_angles() ? Refusal::kNoReference : Refusal::kNone;
}

bool in_range(const SlewCommand& command, double now_s, double lease_max_s) {
  return command.lease_s > 0.0 && command.lease_s <= lease_max_s &&
         std::abs(command.effect_s - now_s) <= kSlewLead_s &&
         std::abs(command.direction.azimuth_rad) <= 2.0 * kPi &&
         std::abs(command.direction.elevation_rad) <= kPi / 2.0 &&
         std::abs(command.azimuth_rate_rad_s) <= kSlewRateLimit_rad_s &&
         std::abs(command.elevation_rate_rad_s) <= kSlewRateLimit_rad_s &&
         command.direction_sd_rad >= 0.0 && command.direction_sd_rad <= kPi &&
         (!command.searches_line() || std::abs(command.line.norm() - 1.0) < 0.01);
}

bool in_range(const OcclusionCommand& command, double now_s) {
  if (command.holds_s < 0.0 || command.holds_s > kOcclusionHolds_s) return false;
  if (!command.exit) return true;
  const auto& exit = *command.exit;
  return std::abs(exit.time_s - now_s) <= kOcclusionHolds_s && exit.sd_s >= 0.0 &&
         std::abs(exit.direction.azimuth_rad) <= 2.0 * kPi &&
         std::abs(exit.direction.elevation_rad) <= kPi / 2.0 && exit.direction_sd_rad >= 0.0 &&
         exit.direction_sd_rad <= kPi;
}

// Why the fusion may not lead the station.
Refusal refuses_fusion(const Situation& situation) {
  const StationMode& mode = situation.mode;
  if (situation.config.overview) return Refusal::kOverview;
  if (!situation.config.moves) return Refusal::kFixedMount;
  if (mode.is(StationState::kEmergency)) return Refusal::kEmergency;
  return Refusal::kNone;
}

}  // namespace

Refusal judge(const DesignateCommand& command, const Situation& situation) {
  const Refusal refusal = situation.mode.refuses_operator(situation.now_s);
  if (refusal != Refusal::kNone) return refusal;
  return finite(command) ? Refusal::kNone : Refusal::kNotFinite;
}

Refusal judge(const SlewCommand& command, const Situation& situation) {
  const StationMode& mode = situation.mode;
  const Refusal refusal = refuses_fusion(situation);
  if (refusal != Refusal::kNone) return refusal;
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

Refusal judge(const OcclusionCommand& command, const Situation& situation) {
  const StationMode& mode = situation.mode;
  const Refusal refusal = refuses_fusion(situation);
  if (refusal != Refusal::kNone) return refusal;
  if (!finite(command)) return Refusal::kNotFinite;
  if (!in_range(command, situation.now_s)) return Refusal::kOutOfRange;
  if (mode.is(StationState::kManual) || mode.is(StationState::kStopped)) {
    return Refusal::kPrecedence;
  }
  if (mode.has_doubtful_angles()) return Refusal::kNoReference;
  const bool may_wait = !command.exit || situation.pointing.aim(command.exit->direction);
  return may_wait ? Refusal::kNone : Refusal::kUnreachable;
}

Refusal judge(const PointCommand& command, const Situation& situation) {
  const StationMode& mode = situation.mode;
  const Refusal refusal = mode.refuses_operator(situation.now_s);
  if (refusal != Refusal::kNone) return refusal;
  if (!finite(command.angles)) return Refusal::kNotFinite;
  if (!in_range(command.angles)) return Refusal::kOutOfRange;
  return refuses_motion(situation);
}

Refusal judge_motion(const Situation& situation) {
  const Refusal refusal = situation.mode.refuses_operator(situation.now_s);
  return refusal != Refusal::kNone ? refusal : refuses_motion(situation);
}

Refusal judge(const RateCommand& command, const Situation& situation) {
  const StationMode& mode = situation.mode;
  const Refusal refusal = mode.refuses_operator(situation.now_s);
  if (refusal != Refusal::kNone) return refusal;
  // A joystick that is still held when somebody else stops the unit must not start it again.
  if (mode.is(StationState::kStopped)) return Refusal::kStopped;
  if (!finite(command)) return Refusal::kNotFinite;
  if (!in_range(command)) return Refusal::kOutOfRange;
  return refuses_motion(situation);
}

// Also when stopped, and in an emergency: a lens is in nobody's way.
Refusal judge(const LensCommand& command, const Situation& situation) {
  return situation.config.zoom ? judge_values(command) : Refusal::kNoLens;
}

Refusal judge_home(const Situation& situation) {
  const Refusal refusal = situation.mode.refuses_operator(situation.now_s);
  if (refusal != Refusal::kNone) return refusal;
  if (!situation.config.moves) return Refusal::kFixedMount;
  if (!situation.config.homing_allowed) return Refusal::kKeepOut;
  if (situation.mode.reference() == mount::Reference::kUnknown) return Refusal::kNoUnit;
  return Refusal::kNone;
}

Refusal judge_reference_ok(const Situation& situation) {
  const StationMode& mode = situation.mode;
  if (mode.is(StationState::kEmergency)) return Refusal::kEmergency;
  if (mode.reference() == mount::Reference::kMissing) return Refusal::kNoReference;
  if (mode.reference() != mount::Reference::kDoubted) return Refusal::kNoDoubt;
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
