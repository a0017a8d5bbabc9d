#include "sim/ptu/motion.h"

#include <algorithm>
#include <cmath>

#include "sim/ptu/command_text.h"

namespace ols::sim {

namespace {

constexpr int kHardStopMargin_steps = 300;  // mechanical stops lie beyond the soft limits

const char* limit_hit(int axis) { return axis == 0 ? "!P" : "!T"; }

}  // namespace

PtuMotion::PtuMotion(const PtuUnitConfig& config, PtuSettings& settings, double power_up_s)
    : config_(config),
      settings_(settings),
      axes_{{{PtuAxis(0.0, power_up_s),
              config.pan_min_counts,
              config.pan_max_counts,
              1,
              0.0,
              config.homed_before,
              {},
              {}},
             {PtuAxis(0.0, power_up_s),
              config.tilt_min_counts,
              config.tilt_max_counts,
              1,
              0.0,
              config.homed_before,
              {},
              {}}}} {}

void PtuMotion::power_up() {
  velocity_mode_ = false;
  immediate_ = true;
  limits_ = Limits::kFactory;
  tokens_.clear();
  for (Axis& axis : axes_) {
    axis.slaved.reset();
    axis.hit_s.reset();
  }
}

void PtuMotion::power_off(double time_s) {
  for (int axis = 0; axis < 2; ++axis) {
    Axis& a = axes_[at(axis)];
    a.motion.halt(profile(axis), time_s);
    a.origin = a.motion.target();
    a.homed = false;
  }
}

std::optional<std::string> PtuMotion::execute(std::string_view command, bool verbose,
                                              double time_s) {
  if (auto answer = modes(command, verbose, time_s)) return answer;
  if (auto answer = limit_modes(command)) return answer;
  if (e_series() && command == "IQ") return immediate_ ? "* I" : "* S";
  return halts(command, time_s);
}

double PtuMotion::position(int axis, double time_s) const {
  return counts(axes_[at(axis)], axes_[at(axis)].motion.position(time_s));
}

double PtuMotion::target(int axis) const {
  const Axis& a = axes_[at(axis)];
  return counts(a, a.slaved.value_or(a.motion.target()));
}

double PtuMotion::velocity(int axis, double time_s) const {
  return axes_[at(axis)].motion.velocity(time_s) / axes_[at(axis)].divisor;
}

double PtuMotion::counts(const Axis& axis, double steps) const {
  return (steps - axis.origin) / axis.divisor;
}

double PtuMotion::steps(const Axis& axis, double counts) const {
  return counts * axis.divisor + axis.origin;
}

int PtuMotion::least(int axis) const {
  return limits_ == Limits::kUser ? settings_.axes[at(axis)].user_least : factory_least(axis);
}

int PtuMotion::greatest(int axis) const {
  return limits_ == Limits::kUser ? settings_.axes[at(axis)].user_greatest : factory_greatest(axis);
}

PtuAxis::Profile PtuMotion::profile(int axis) const {
  const PtuAxisSettings& s = settings_.axes[at(axis)];
  const double steps_a_count = axes_[at(axis)].divisor;
  return {steps_a_count * std::max(1.0, std::abs(static_cast<double>(s.speed))),
          steps_a_count * s.acceleration, steps_a_count * s.base_speed};
}

std::string PtuMotion::set_position(int axis, int target, double time_s) {
  Axis& a = axes_[at(axis)];
  if (velocity_mode_) return kIllegalCommand;
  if (limits_ != Limits::kOff && target > greatest(axis)) {
    return "! Maximum allowable " + std::string(ptu_axis_name(axis)) + " position is " +
           std::to_string(greatest(axis));
  }
  if (limits_ != Limits::kOff && target < least(axis)) {
    return "! Minimum allowable " + std::string(ptu_axis_name(axis)) + " position is " +
           std::to_string(least(axis));
  }
  if (immediate_) {
    start(axis, target, time_s);
  } else {
    a.slaved = steps(a, target);
  }
  return "*";
}

std::string PtuMotion::set_speed(int axis, int speed, double time_s) {
  PtuAxisSettings& s = settings_.axes[at(axis)];
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
    start(axis, speed > 0 ? greatest(axis) : least(axis), time_s);
    a.hit_s = a.motion.rest_s();
  } else if (a.motion.rest_s() > time_s) {
    start_steps(axis, a.motion.target(), time_s);
  }
  return "*";
}

// A D46 accepts these only at rest. Its answer otherwise is not documented; this is the only
// refusal seen on real units.
std::string PtuMotion::set_parameter(int axis, char what, int value, double time_s) {
  PtuAxisSettings& s = settings_.axes[at(axis)];
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

void PtuMotion::start(int axis, double target_counts, double time_s) {
  start_steps(axis, steps(axes_[at(axis)], target_counts), time_s);
}

// Without soft limits the axis runs into its mechanical stop and loses only the distance beyond.
void PtuMotion::start_steps(int axis, double target_steps, double time_s) {
  Axis& a = axes_[at(axis)];
  const double reached = std::clamp<double>(target_steps, a.least - kHardStopMargin_steps,
                                            a.greatest + kHardStopMargin_steps);
  a.slaved.reset();
  a.motion.move(reached, profile(axis), time_s);
  a.hit_s = reached == target_steps ? std::nullopt : std::optional(a.motion.rest_s());
}

void PtuMotion::start_slaved(double time_s) {
  for (int axis = 0; axis < 2; ++axis) {
    if (const auto target = axes_[at(axis)].slaved) start_steps(axis, *target, time_s);
  }
}

void PtuMotion::stop(int axis, double time_s) {
  Axis& a = axes_[at(axis)];
  a.slaved.reset();
  a.hit_s.reset();
  a.motion.halt(profile(axis), time_s);
}

void PtuMotion::enter_velocity_mode(bool velocity, double time_s) {
  if (velocity == velocity_mode_) return;
  for (int axis = 0; axis < 2; ++axis) {
    PtuAxisSettings& s = settings_.axes[at(axis)];
    stop(axis, time_s);
    s.speed = std::max(std::abs(s.speed), s.lower_speed);
  }
  velocity_mode_ = velocity;
}

// Real units use both wordings.
std::string PtuMotion::refuse_speed(int axis, int fastest) const {
  return std::string("! ") + ptu_axis_name(axis) + " speed cannot exceed " +
         std::to_string(fastest) + (e_series() ? " positions/sec" : " pos/sec");
}

double PtuMotion::home(bool pan, bool tilt, double time_s) {
  double end_s = time_s;
  for (const int axis : {1, 0}) {
    if (axis == 0 ? pan : tilt) end_s = home_axis(axis, end_s);
  }
  if (pan || tilt) end_s = std::max({end_s, axes_[0].motion.rest_s(), axes_[1].motion.rest_s()});
  return end_s;
}

double PtuMotion::home_together(double time_s) {
  home_axis(1, time_s);
  home_axis(0, time_s);
  std::stable_sort(tokens_.begin(), tokens_.end(),
                   [](const PtuToken& a, const PtuToken& b) { return a.time_s < b.time_s; });
  return std::max(axes_[0].motion.rest_s(), axes_[1].motion.rest_s());
}

// To both ends, then towards zero. Returns when the second end is reached.
double PtuMotion::home_axis(int axis, double time_s) {
  Axis& a = axes_[at(axis)];
  take_step_mode(axis);
  PtuAxis::Profile homing = profile(axis);
  homing.speed = static_cast<double>(settings_.axes[at(axis)].home_speed) * a.divisor;
  homing.acceleration = 2.0 * homing.speed;
  a.slaved.reset();
  a.hit_s.reset();
  double end_s = time_s;
  for (const int end : {a.least, a.greatest}) {
    a.motion.move(end, homing, end_s);
    end_s = a.motion.rest_s();
    tokens_.push_back({end_s, limit_hit(axis)});
  }
  a.motion.move(0.0, homing, end_s);
  a.origin = 0.0;
  a.homed = true;
  return end_s;
}

// A new step mode applies from the next reset on; it changes the steps per count.
void PtuMotion::take_step_mode(int axis) {
  Axis& a = axes_[at(axis)];
  PtuAxisSettings& s = settings_.axes[at(axis)];
  const int divisor = s.step_mode == 'F' ? 8 : s.step_mode == 'H' ? 4 : s.step_mode == 'Q' ? 2 : 1;
  if (divisor == a.divisor) return;
  for (int* value : {&s.speed, &s.acceleration, &s.base_speed, &s.upper_speed, &s.lower_speed,
                     &s.user_least, &s.user_greatest, &s.home_speed}) {
    *value = *value * a.divisor / divisor;
  }
  a.divisor = divisor;
}

std::optional<std::string> PtuMotion::modes(std::string_view command, bool verbose, double time_s) {
  if (command == "C") {
    if (e_series()) {  // in terse mode, too
      return velocity_mode_ ? "* Pure Velocity speed control mode"
                            : "* Independent speed control mode";
    }
    if (!verbose) return velocity_mode_ ? "* p" : "* i";
    return velocity_mode_ ? "* PTU is in pure velocity mode" : "* PTU is in independent mode";
  }
  if (command == "CI" || command == "CV") {
    enter_velocity_mode(command == "CV", time_s);
  } else if (command == "I") {
    immediate_ = true;
    start_slaved(time_s);
  } else if (command == "S") {
    immediate_ = false;
  } else {
    return std::nullopt;
  }
  return "*";
}

std::optional<std::string> PtuMotion::limit_modes(std::string_view command) {
  if (command == "L" || (command == "IL" && e_series())) {
    if (limits_ == Limits::kOff) return "* Limit bounds are DISABLED (hard limits only: use care)";
    return limits_ == Limits::kUser ? "* Limit bounds are ENABLED (user limits enabled)"
                                    : "* Limit bounds are ENABLED (soft limits enabled)";
  }
  if (command == "LE") {
    limits_ = Limits::kFactory;
  } else if (command == "LD") {
    limits_ = Limits::kOff;
  } else if (command == "LU" && e_series()) {
    limits_ = Limits::kUser;
  } else {
    return std::nullopt;
  }
  return "*";
}

std::optional<std::string> PtuMotion::halts(std::string_view command, double time_s) {
  if (command != "H" && command != "HP" && command != "HT") return std::nullopt;
  if (command != "HT") stop(0, time_s);
  if (command != "HP") stop(1, time_s);
  return "*";
}

std::vector<PtuToken> PtuMotion::take_tokens(double time_s) {
  std::vector<PtuToken> due;
  while (!tokens_.empty() && tokens_.front().time_s <= time_s) {
    due.push_back(tokens_.front());
    tokens_.erase(tokens_.begin());
  }
  for (int axis = 0; axis < 2; ++axis) {
    Axis& a = axes_[at(axis)];
    if (!a.hit_s || *a.hit_s > time_s) continue;
    due.push_back({*a.hit_s, limit_hit(axis)});
    a.hit_s.reset();
  }
  return due;
}

std::optional<double> PtuMotion::next_token_s() const {
  std::optional<double> next;
  if (!tokens_.empty()) next = tokens_.front().time_s;
  for (const Axis& axis : axes_) {
    if (axis.hit_s && (!next || *axis.hit_s < *next)) next = axis.hit_s;
  }
  return next;
}

void PtuMotion::slip(int axis, int slipped_steps, double time_s) {
  Axis& a = axes_[at(axis)];
  a.motion.shift(slipped_steps, time_s);
  a.origin += slipped_steps;
}

void PtuMotion::forget(double before_s) {
  for (Axis& axis : axes_) axis.motion.forget(before_s);
}

}  // namespace ols::sim
