// How the simulated PTU moves: positions, speeds and the limits of both.
#include <algorithm>
#include <cmath>

#include "sim/ptu_controller.h"

namespace ols::sim {

namespace {

constexpr int kHardStopMargin_steps = 300;  // mechanical stops lie beyond the soft limits

}  // namespace

double PtuController::counts(const Axis& axis, double steps) const {
  return (steps - axis.origin) / axis.divisor;
}

double PtuController::steps(const Axis& axis, double counts) const {
  return counts * axis.divisor + axis.origin;
}

int PtuController::least(int axis) const {
  return limits_ == Limits::kUser ? settings_.axes[at(axis)].user_least
                                  : axes_[at(axis)].least / axes_[at(axis)].divisor;
}

int PtuController::greatest(int axis) const {
  return limits_ == Limits::kUser ? settings_.axes[at(axis)].user_greatest
                                  : axes_[at(axis)].greatest / axes_[at(axis)].divisor;
}

PtuAxis::Profile PtuController::profile(int axis) const {
  const AxisSettings& s = settings_.axes[at(axis)];
  const double steps_a_count = axes_[at(axis)].divisor;
  return {steps_a_count * std::max(1.0, std::abs(static_cast<double>(s.speed))),
          steps_a_count * s.acceleration, steps_a_count * s.base_speed};
}

std::string PtuController::set_position(int axis, int target, double time_s) {
  Axis& a = axes_[at(axis)];
  if (velocity_mode_) return kIllegalCommand;
  if (limits_ != Limits::kOff && target > greatest(axis)) {
    return "! Maximum allowable " + a.name + " position is " + std::to_string(greatest(axis));
  }
  if (limits_ != Limits::kOff && target < least(axis)) {
    return "! Minimum allowable " + a.name + " position is " + std::to_string(least(axis));
  }
  if (immediate_) {
    start(axis, steps(a, target), time_s);
  } else {
    a.slaved = steps(a, target);
  }
  return "*";
}

std::string PtuController::set_speed(int axis, int speed, double time_s) {
  AxisSettings& s = settings_.axes[at(axis)];
  Axis& a = axes_[at(axis)];
  if (std::abs(speed) > s.upper_speed) return refuse_speed(axis, s.upper_speed);
  const bool rest = velocity_mode_ && speed == 0;
  const int least_speed = velocity_mode_ ? std::abs(speed) : speed;
  if (!rest && least_speed < s.lower_speed) {
    return "! Motor speed cannot be less than " + std::to_string(s.lower_speed) + " pos/sec";
  }
  if (rest) {
    a.motion.halt(profile(axis), time_s);
    s.speed = 0;
    return "*";
  }
  s.speed = speed;
  if (velocity_mode_) {
    start(axis, steps(a, speed > 0 ? greatest(axis) : least(axis)), time_s);
    a.hit_s = a.motion.rest_s();
  } else if (a.motion.rest_s() > time_s) {
    start(axis, a.motion.target(), time_s);
  }
  return "*";
}

// A D46 takes these only at rest. What it says otherwise is not documented; this is the only
// refusal seen anywhere.
std::string PtuController::set_parameter(int axis, char what, int value, double time_s) {
  AxisSettings& s = settings_.axes[at(axis)];
  const bool moving = axes_[at(axis)].motion.rest_s() > time_s;
  if ((moving && !e_series()) || value <= 0) return kIllegalCommand;
  const int fastest = config_.max_speed_counts_s / axes_[at(axis)].divisor;
  if (what == 'U' && value > fastest) return refuse_speed(axis, fastest);
  int& parameter = what == 'A'   ? s.acceleration
                   : what == 'B' ? s.base_speed
                   : what == 'U' ? s.upper_speed
                                 : s.lower_speed;
  parameter = value;
  return "*";
}

// Without soft limits the axis runs into its mechanical stop and loses nothing but the way beyond.
void PtuController::start(int axis, double target_steps, double time_s) {
  Axis& a = axes_[at(axis)];
  const double reached = std::clamp<double>(target_steps, a.least - kHardStopMargin_steps,
                                            a.greatest + kHardStopMargin_steps);
  a.slaved.reset();
  a.motion.move(reached, profile(axis), time_s);
  a.hit_s = reached == target_steps ? std::nullopt : std::optional(a.motion.rest_s());
}

void PtuController::start_slaved(double time_s) {
  for (int axis = 0; axis < 2; ++axis) {
    if (const auto target = axes_[at(axis)].slaved) start(axis, *target, time_s);
  }
}

void PtuController::stop(int axis, double time_s) {
  Axis& a = axes_[at(axis)];
  a.slaved.reset();
  a.hit_s.reset();
  a.motion.halt(profile(axis), time_s);
}

void PtuController::enter_velocity_mode(bool velocity, double time_s) {
  if (velocity == velocity_mode_) return;
  for (int axis = 0; axis < 2; ++axis) {
    AxisSettings& s = settings_.axes[at(axis)];
    stop(axis, time_s);
    s.speed = std::max(std::abs(s.speed), s.lower_speed);
  }
  velocity_mode_ = velocity;
}

std::vector<PtuToken> PtuController::take_tokens(double time_s) {
  std::vector<PtuToken> due;
  while (!tokens_.empty() && tokens_.front().time_s <= time_s) {
    due.push_back(tokens_.front());
    tokens_.erase(tokens_.begin());
  }
  for (Axis& axis : axes_) {
    if (!axis.hit_s || *axis.hit_s > time_s) continue;
    due.push_back({*axis.hit_s, axis.name == "Pan" ? "!P" : "!T"});
    axis.hit_s.reset();
  }
  if (!selected_) due.clear();
  return due;
}

std::optional<double> PtuController::next_token_s() const {
  std::optional<double> next;
  if (!tokens_.empty()) next = tokens_.front().time_s;
  for (const Axis& axis : axes_) {
    if (axis.hit_s && (!next || *axis.hit_s < *next)) next = axis.hit_s;
  }
  return next;
}

}  // namespace ols::sim
