#include "edge/ptu/servo.h"

#include <algorithm>
#include <cmath>

#include "geometry/angles.h"

namespace ols::ptu {

namespace {

struct AxisGoal {
  double angle_rad;
  double rate_rad_s;
  bool rests;
};

struct AxisCommand {
  double position_rad;
  double speed_rad_s;
};

// The goal on one axis at an instant, kept within its limits; at a limit its rate is zero.
AxisGoal goal_at(double angle_rad, double rate_rad_s, double dt_s, double min, double max) {
  const double angle = angle_rad + rate_rad_s * dt_s;
  const bool outward = (angle >= max && rate_rad_s > 0.0) || (angle <= min && rate_rad_s < 0.0);
  return {std::clamp(angle, min, max), outward ? 0.0 : rate_rad_s, false};
}

// The speed from which the unit can still brake before the goal, with a margin in acceleration.
double brakable_speed(const ServoConfig& config, double error_rad) {
  const double speed = std::sqrt(2.0 * 0.8 * config.max_acceleration_rad_s2 * std::abs(error_rad));
  return std::copysign(speed, error_rad);
}

// The speed that closes the error: proportional near the goal, so that the measured error of a goal
// that moves is not answered with jerks; further away the speed from which the unit can brake.
double closing_speed(const ServoConfig& config, double error_rad) {
  const double proportional = config.gain_hz * error_rad;
  const double brakable = brakable_speed(config, error_rad);
  return std::abs(proportional) < std::abs(brakable) ? proportional : brakable;
}

// How far ahead a unit at this speed is commanded: the travel during the look-ahead plus the
// braking distance v^2/2a.
double reach_ahead(const ServoConfig& config, double speed_rad_s, double look_ahead_s) {
  return std::abs(speed_rad_s) * look_ahead_s +
         speed_rad_s * speed_rad_s / (2.0 * config.max_acceleration_rad_s2);
}

// How far ahead a unit may be sent that is at `now_rad_s` and may speed up to `speed_rad_s`: what
// it travels during the look-ahead, and what it then brakes over. Left alone there it stands after
// the look-ahead and v/a, at whatever speed it was.
double reach_from(const ServoConfig& config, double now_rad_s, double speed_rad_s) {
  const double begins = std::clamp(now_rad_s, 0.0, speed_rad_s);
  const double gained = config.max_acceleration_rad_s2 * config.look_ahead_s;
  const double ends = std::min(begins + gained, speed_rad_s);
  const double speeding_s = (ends - begins) / config.max_acceleration_rad_s2;
  return 0.5 * (begins + ends) * speeding_s +
         reach_ahead(config, ends, config.look_ahead_s - speeding_s);
}

// Where the unit is to rest it brakes by itself, in the time that its own ramp takes: a
// proportional speed would let it creep for seconds. The goal is commanded as soon as it is within
// reach.
AxisCommand resting_step(const ServoConfig& config, double error_rad, double now_rad,
                         double now_rad_s) {
  const double speed =
      std::max(config.min_speed_rad_s,
               std::min(std::abs(brakable_speed(config, error_rad)), config.max_speed_rad_s));
  const double furthest_rad = reach_from(config, std::copysign(1.0, error_rad) * now_rad_s, speed);
  return {now_rad + std::clamp(error_rad, -furthest_rad, furthest_rad), speed};
}

// The commanded position is where the goal would come to rest if it continued for the look-ahead
// and then braked. So the unit does not brake while commands arrive, and when they stop it stands
// after the look-ahead plus v/a. A goal that rests, or is slower than the unit's minimum speed, is
// commanded exactly, from far away in stages.
AxisCommand axis_step(const ServoConfig& config, const AxisGoal& goal, double now_rad,
                      double now_rad_s) {
  const double error_rad = goal.angle_rad - now_rad;
  if (goal.rests) return resting_step(config, error_rad, now_rad, now_rad_s);
  const double speed = std::clamp(goal.rate_rad_s + closing_speed(config, error_rad),
                                  -config.max_speed_rad_s, config.max_speed_rad_s);
  const double rate = std::clamp(goal.rate_rad_s, -config.max_speed_rad_s, config.max_speed_rad_s);
  const bool moves = std::abs(rate) > config.min_speed_rad_s;
  double way_rad = error_rad;
  if (moves) way_rad += std::copysign(reach_ahead(config, rate, config.look_ahead_s), rate);
  // Too far ahead of a moving goal: back, or wait for it, along the wanted speed.
  if (moves && way_rad * speed < 0.0) way_rad = speed * config.look_ahead_s;
  // Near a resting goal the speed is gain * error, so that 1/gain of travel is the whole way there.
  const double furthest_rad = reach_ahead(config, std::max(std::abs(speed), config.min_speed_rad_s),
                                          std::max(config.look_ahead_s, 1.0 / config.gain_hz));
  way_rad = std::clamp(way_rad, -furthest_rad, furthest_rad);
  return {now_rad + way_rad, std::max(std::abs(speed), config.min_speed_rad_s)};
}

// With its reaction time, how far a unit at this speed still comes.
double stopping_way(const ServoConfig& config, double speed_rad_s) {
  constexpr double kReaction_s = 0.03;
  const double way = std::abs(speed_rad_s) * kReaction_s +
                     speed_rad_s * speed_rad_s / (2.0 * config.max_acceleration_rad_s2);
  return std::copysign(way, speed_rad_s);
}

// A rate without a goal. A stopping axis holds where it comes to rest, not where it was when the
// command came: it would turn back.
AxisCommand rate_step(const ServoConfig& config, double wanted_rad_s, double now_rad,
                      double now_rad_s) {
  const double rate = std::clamp(wanted_rad_s, -config.max_speed_rad_s, config.max_speed_rad_s);
  if (rate == 0.0) {
    return {now_rad + stopping_way(config, now_rad_s),
            std::max(std::abs(now_rad_s), config.min_speed_rad_s)};
  }
  const double speed = std::max(std::abs(rate), config.min_speed_rad_s);
  return {now_rad + std::copysign(reach_ahead(config, speed, config.look_ahead_s), rate), speed};
}

// False for limits that contradict each other.
bool room_within(const mount::Limits& limits) {
  return limits.pan_min_rad <= limits.pan_max_rad && limits.tilt_min_rad <= limits.tilt_max_rad;
}

PanTilt clamped(const mount::Limits& limits, const PanTilt& p) {
  return {std::clamp(p.pan_rad, limits.pan_min_rad, limits.pan_max_rad),
          std::clamp(p.tilt_rad, limits.tilt_min_rad, limits.tilt_max_rad)};
}

bool usable(const mount::Goal& goal) {
  return std::isfinite(goal.time_s) && std::isfinite(goal.angles.pan_rad) &&
         std::isfinite(goal.angles.tilt_rad) && std::isfinite(goal.rate.pan_rad) &&
         std::isfinite(goal.rate.tilt_rad);
}

// Where a unit that brakes now comes to rest, including its reaction time.
PanTilt stopping_place(const ServoConfig& config, const PanTilt& now, const PanTilt& rate) {
  return {now.pan_rad + stopping_way(config, rate.pan_rad),
          now.tilt_rad + stopping_way(config, rate.tilt_rad)};
}

// The next corner of the path around the keep-out regions; nothing if the direct path is free or no
// path exists.
std::optional<PanTilt> corner(const mount::Limits& limits, const PanTilt& now, const PanTilt& to) {
  if (limits.keep_out.empty()) return std::nullopt;
  const auto way = way_round(travel(limits), limits.keep_out, now, to);
  return way && way->size() > 1 ? std::optional(way->front()) : std::nullopt;
}

// From inside a region no rate is obeyed: which way leads out of it, only a goal can say.
std::optional<ServoCommand> rates_step(const ServoConfig& config, const mount::Limits& limits,
                                       const PanTilt& rate, const PanTilt& now,
                                       const PanTilt& now_rate) {
  if (blocked(limits.keep_out, now)) return std::nullopt;
  const AxisCommand pan = rate_step(config, rate.pan_rad, now.pan_rad, now_rate.pan_rad);
  const AxisCommand tilt = rate_step(config, rate.tilt_rad, now.tilt_rad, now_rate.tilt_rad);
  const PanTilt wanted = clamped(limits, {pan.position_rad, tilt.position_rad});
  const PanTilt stops_at = stopping_place(config, now, now_rate);
  return ServoCommand{cut_short(limits.keep_out, now, stops_at, wanted),
                      {pan.speed_rad_s, tilt.speed_rad_s}};
}

}  // namespace

std::optional<ServoCommand> servo_step(const ServoConfig& config, const mount::Limits& limits,
                                       const std::optional<mount::Goal>& goal, const PanTilt& now,
                                       double time_s, const PanTilt& now_rate) {
  if (!goal || !(time_s <= goal->valid_until_s)) return std::nullopt;
  const double dt_s = time_s - goal->time_s;
  if (!(dt_s <= config.goal_timeout_s)) return std::nullopt;
  if (!usable(*goal) || !std::isfinite(dt_s) || !room_within(limits)) return std::nullopt;
  if (goal->rate_only) return rates_step(config, limits, goal->rate, now, now_rate);
  AxisGoal pan_goal = goal_at(goal->angles.pan_rad, goal->rate.pan_rad, dt_s, limits.pan_min_rad,
                              limits.pan_max_rad);
  AxisGoal tilt_goal = goal_at(goal->angles.tilt_rad, goal->rate.tilt_rad, dt_s,
                               limits.tilt_min_rad, limits.tilt_max_rad);
  const auto turn = corner(limits, now, {pan_goal.angle_rad, tilt_goal.angle_rad});
  pan_goal.rests = tilt_goal.rests = goal->rests;
  if (turn) {
    pan_goal = {turn->pan_rad, 0.0, goal->rests};
    tilt_goal = {turn->tilt_rad, 0.0, goal->rests};
  }
  const AxisCommand pan = axis_step(config, pan_goal, now.pan_rad, now_rate.pan_rad);
  const AxisCommand tilt = axis_step(config, tilt_goal, now.tilt_rad, now_rate.tilt_rad);
  ServoCommand command;
  command.position = clamped(limits, {pan.position_rad, tilt.position_rad});
  command.speed = {pan.speed_rad_s, tilt.speed_rad_s};
  // From inside a region the unit may only move out of it.
  if (!blocked(limits.keep_out, now)) {
    command.position =
        cut_short(limits.keep_out, now, stopping_place(config, now, now_rate), command.position);
  } else if (!turn) {
    return std::nullopt;
  }
  return command;
}

double runs_on_s(const ServoConfig& config, double speed_rad_s) {
  // On the way to a resting goal it is up to 1/gain of travel ahead, at a proportional speed.
  return std::max(config.look_ahead_s, 1.0 / config.gain_hz) +
         std::abs(speed_rad_s) / config.max_acceleration_rad_s2;
}

bool runs_on_too_long(const ServoConfig& config) {
  const double speed = std::min(config.max_speed_rad_s, kRunsOnSpeed_rad_s);
  return runs_on_s(config, speed) > kRunsOnAtMost_s;
}

double max_safe_speed_rad_s(const ServoConfig& config) {
  if (!runs_on_too_long(config)) return config.max_speed_rad_s;
  const double braking_s = kRunsOnAtMost_s - runs_on_s(config, 0.0);
  return std::max(0.0, braking_s * config.max_acceleration_rad_s2);
}

}  // namespace ols::ptu
