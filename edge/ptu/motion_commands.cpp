#include "edge/ptu/motion_commands.h"

#include <algorithm>
#include <cmath>

#include "conditions/printed.h"
#include "geometry/angles.h"

namespace ols::ptu {

namespace {

// There is no checksum: a command corrupted on the line is replaced after this time.
constexpr double kRefresh_s = 1.0;
constexpr double kHaltMargin_s = 0.3;  // on top of the braking time, before a halt is repeated

constexpr double kRounding_counts = 1e-6;  // a limit that is a whole count stays that count

double min_within(const PtuAxisFacts& facts, double min_rad) {
  return std::ceil(min_rad / facts.resolution_rad - kRounding_counts);
}

double max_within(const PtuAxisFacts& facts, double max_rad) {
  return std::floor(max_rad / facts.resolution_rad + kRounding_counts);
}

mount::Limits narrowed(const mount::Limits& configured, const PtuFacts& facts) {
  mount::Limits both = configured;
  both.pan_min_rad = std::max(both.pan_min_rad, facts.pan.min * facts.pan.resolution_rad);
  both.pan_max_rad = std::min(both.pan_max_rad, facts.pan.max * facts.pan.resolution_rad);
  both.tilt_min_rad = std::max(both.tilt_min_rad, facts.tilt.min * facts.tilt.resolution_rad);
  both.tilt_max_rad = std::min(both.tilt_max_rad, facts.tilt.max * facts.tilt.resolution_rad);
  both.count = {facts.pan.resolution_rad, facts.tilt.resolution_rad};
  return both;
}

struct Range {
  double min_rad, max_rad;
};

std::string axis_conflict(const char* name, const PtuAxisFacts& facts, const Range& configured,
                          const Range& both) {
  const bool room = both.min_rad < both.max_rad &&
                    min_within(facts, both.min_rad) <= max_within(facts, both.max_rad);
  if (room) return {};
  return printed(
      "no %s lies within both the configured limits, %.2f to %.2f deg, and the unit's, "
      "%.2f to %.2f deg",
      name, degrees(configured.min_rad), degrees(configured.max_rad),
      degrees(facts.min * facts.resolution_rad), degrees(facts.max * facts.resolution_rad));
}

}  // namespace

std::string limits_conflict(const mount::Limits& configured, const PtuFacts& facts) {
  const mount::Limits both = narrowed(configured, facts);
  std::string pan =
      axis_conflict("pan", facts.pan, {configured.pan_min_rad, configured.pan_max_rad},
                    {both.pan_min_rad, both.pan_max_rad});
  if (!pan.empty()) return pan;
  return axis_conflict("tilt", facts.tilt, {configured.tilt_min_rad, configured.tilt_max_rad},
                       {both.tilt_min_rad, both.tilt_max_rad});
}

MotionCommands::MotionCommands(const PtuConfig& config, const PtuFacts& facts)
    : servo_(config.servo),
      limits_(narrowed(config.limits, facts)),
      pan_(axis(PtuAxis::kPan, facts.pan, limits_.pan_min_rad, limits_.pan_max_rad)),
      tilt_(axis(PtuAxis::kTilt, facts.tilt, limits_.tilt_min_rad, limits_.tilt_max_rad)) {
  const auto rad = [](const PtuAxisFacts& axis, std::int32_t counts) {
    return counts * axis.resolution_rad;
  };
  servo_.max_speed_rad_s = std::min({servo_.max_speed_rad_s, rad(facts.pan, facts.pan.upper_speed),
                                     rad(facts.tilt, facts.tilt.upper_speed)});
  servo_.min_speed_rad_s = std::max({servo_.min_speed_rad_s, rad(facts.pan, facts.pan.lower_speed),
                                     rad(facts.tilt, facts.tilt.lower_speed)});
  // The actual acceleration decides where the unit can stop.
  servo_.max_acceleration_rad_s2 =
      std::min(rad(facts.pan, facts.pan.acceleration), rad(facts.tilt, facts.tilt.acceleration));
  keep_running_on_short();
  braking_s_ = servo_.max_speed_rad_s / servo_.max_acceleration_rad_s2;
}

// The configuration was checked with the acceleration that it asks for; a unit may keep its own.
void MotionCommands::keep_running_on_short() {
  if (!runs_on_too_long(servo_)) return;
  servo_.max_speed_rad_s = std::max(servo_.min_speed_rad_s, max_safe_speed_rad_s(servo_));
  lowered_ = PtuLoweredSpeed{servo_.max_acceleration_rad_s2, servo_.max_speed_rad_s};
}

MotionCommands::Axis MotionCommands::axis(PtuAxis name, const PtuAxisFacts& facts, double min_rad,
                                          double max_rad) {
  return {name, facts, static_cast<std::int32_t>(min_within(facts, min_rad)),
          static_cast<std::int32_t>(max_within(facts, max_rad))};
}

PtuRequest MotionCommands::next(const std::optional<mount::Goal>& goal, const Now& now,
                                double time_s) {
  const auto command = servo_step(servo_, limits_, goal, now.angles, time_s, now.rate_rad_s);
  if (!command) return halt(now, time_s);
  change_ = {change(command->speed.pan_rad, command->position.pan_rad - now.angles.pan_rad,
                    now.rate_rad_s.pan_rad),
             change(command->speed.tilt_rad, command->position.tilt_rad - now.angles.tilt_rad,
                    now.rate_rad_s.tilt_rad)};
  PtuRequest request;
  halted_s_.reset();
  if (time_s - refreshed_s_ >= kRefresh_s) send_all_again();
  if (!pan_.position) refreshed_s_ = time_s;
  add_speed(pan_, command->speed.pan_rad, request);
  add_speed(tilt_, command->speed.tilt_rad, request);
  add_position(pan_, command->position.pan_rad, request);
  add_position(tilt_, command->position.tilt_rad, request);
  return request;
}

PtuRequest MotionCommands::halt(const Now& now, double time_s) {
  const bool again = !now.standing && halted_s_ && time_s - *halted_s_ > braking_s_ + kHaltMargin_s;
  change_ = {std::abs(now.rate_rad_s.pan_rad), std::abs(now.rate_rad_s.tilt_rad)};
  return halted_s_ && !again ? PtuRequest() : halt_again(now, time_s);
}

// From the current speed to the commanded one, or to rest if the commanded position is near.
double MotionCommands::change(double speed_rad_s, double way_rad, double rate_rad_s) const {
  constexpr double kCycle_s = 0.05;
  const double stopping_rad = rate_rad_s * rate_rad_s / (2.0 * servo_.max_acceleration_rad_s2) +
                              std::abs(rate_rad_s) * kCycle_s;
  const double to_speed = std::abs(std::copysign(speed_rad_s, way_rad) - rate_rad_s);
  if (std::abs(way_rad) > stopping_rad) return to_speed;
  // A move of zero counts has no effect.
  return std::abs(way_rad) > pan_.facts.resolution_rad ? std::max(to_speed, std::abs(rate_rad_s))
                                                       : std::abs(rate_rad_s);
}

PtuRequest MotionCommands::halt_again(const Now& now, double time_s) {
  change_ = {std::abs(now.rate_rad_s.pan_rad), std::abs(now.rate_rad_s.tilt_rad)};
  halted_s_ = time_s;
  send_all_again();
  return PtuRequest().plain("H");
}

void MotionCommands::send_all_again() {
  for (Axis* axis : {&pan_, &tilt_}) {
    axis->position.reset();
    axis->speed.reset();
  }
}

void MotionCommands::add_speed(Axis& axis, double speed_rad_s, PtuRequest& request) {
  const auto speed =
      std::clamp(static_cast<std::int32_t>(std::lround(speed_rad_s / axis.facts.resolution_rad)),
                 std::max(1, axis.facts.lower_speed), axis.facts.upper_speed);
  if (axis.speed == speed) return;
  axis.speed = speed;
  request.set(axis.name, PtuQuantity::kSpeed, speed);
}

void MotionCommands::add_position(Axis& axis, double position_rad, PtuRequest& request) {
  const auto position =
      std::clamp(static_cast<std::int32_t>(std::lround(position_rad / axis.facts.resolution_rad)),
                 axis.min, axis.max);
  if (axis.position == position) return;
  axis.position = position;
  request.set(axis.name, PtuQuantity::kPosition, position);
}

}  // namespace ols::ptu
