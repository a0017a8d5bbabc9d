#include "tools/sim/ptu_controller.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "geometry/angles.h"

namespace ols::sim {

namespace {

constexpr const char* kIllegal = "! Illegal Command Entered";
constexpr int kHardStopMargin_counts = 300;  // mechanical stops lie beyond the soft limits

std::string upper(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return result;
}

std::optional<int> whole_number(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

PtuController::PtuController(const PtuUnitConfig& config, double power_up_s)
    : config_(config),
      settings_{config.echo,
                config.verbose,
                {{{1000, config.acceleration_counts_s2, config.base_speed_counts_s,
                   config.max_speed_counts_s, config.min_speed_counts_s, 'R', 'R'},
                  {1000, config.acceleration_counts_s2, config.base_speed_counts_s,
                   config.max_speed_counts_s, config.min_speed_counts_s, 'R', 'R'}}}},
      saved_(settings_),
      axes_{
          {{PtuAxis(0.0, power_up_s), "Pan", config.pan_min_counts, config.pan_max_counts, {}, {}},
           {PtuAxis(0.0, power_up_s),
            "Tilt",
            config.tilt_min_counts,
            config.tilt_max_counts,
            {},
            {}}}},
      baud_(config.baud) {}

PtuAnswer PtuController::power_up(double time_s) {
  return {"*", config_.home_at_power_up ? home(time_s) : time_s};
}

PtuAnswer PtuController::execute(std::string_view command_text, double time_s) {
  const std::string command = upper(command_text);
  const bool of_axis = command.size() >= 2 && (command[0] == 'P' || command[0] == 'T');
  if (command == "R") return {"*", home(time_s)};
  if (command == "A") {
    start_slaved(time_s);
    return {"*", std::max({time_s, axes_[0].motion.rest_s(), axes_[1].motion.rest_s()})};
  }
  if (const auto answer = mode(command, time_s)) return {*answer, time_s};
  if (const auto answer = halts(command, time_s)) return {*answer, time_s};
  if (command.starts_with("@(")) return {change_baud(command), time_s};
  if (!of_axis) return {kIllegal, time_s};

  const int axis = command[0] == 'P' ? 0 : 1;
  const char what = command[1];
  if (what == 'H' || what == 'M') return {power(axis, command.substr(1)), time_s};
  if (command.size() == 2) return {query(axis, what, time_s), time_s};
  const auto value = whole_number(std::string_view(command).substr(2));
  if (!value) return {kIllegal, time_s};
  const bool slow = std::string_view("ABUL").find(what) != std::string_view::npos;
  return {set(axis, what, *value, time_s), time_s + (slow ? config_.parameter_set_s : 0.0)};
}

PtuAxis::Profile PtuController::profile(int axis) const {
  const AxisSettings& s = settings_.axes[at(axis)];
  return {std::max(1.0, std::abs(static_cast<double>(s.speed))),
          static_cast<double>(s.acceleration), static_cast<double>(s.base_speed)};
}

std::string PtuController::set(int axis, char what, int value, double time_s) {
  const PtuAxis& motion = axes_[at(axis)].motion;
  switch (what) {
    case 'P':
      return set_position(axis, value, time_s);
    case 'O':
      return set_position(axis, static_cast<int>(std::lround(motion.position(time_s))) + value,
                          time_s);
    case 'S':
      return set_speed(axis, value, time_s);
    case 'D':
      return set_speed(axis, static_cast<int>(std::lround(motion.velocity(time_s))) + value,
                       time_s);
    case 'A':
    case 'B':
    case 'U':
    case 'L':
      return set_parameter(axis, what, value, time_s);
    default:
      return kIllegal;
  }
}

std::string PtuController::set_position(int axis, int target, double time_s) {
  Axis& a = axes_[at(axis)];
  if (velocity_mode_) return kIllegal;
  if (limits_ && target > a.greatest) {
    return "! Maximum allowable " + a.name + " position is " + std::to_string(a.greatest);
  }
  if (limits_ && target < a.least) {
    return "! Minimum allowable " + a.name + " position is " + std::to_string(a.least);
  }
  if (immediate_) {
    start(axis, target, time_s);
  } else {
    a.slaved = target;
  }
  return "*";
}

std::string PtuController::set_speed(int axis, int speed, double time_s) {
  AxisSettings& s = settings_.axes[at(axis)];
  Axis& a = axes_[at(axis)];
  if (std::abs(speed) > s.upper_speed) {
    return "! " + a.name + " speed cannot exceed " + std::to_string(s.upper_speed) +
           " positions/sec";
  }
  const bool stop = velocity_mode_ && speed == 0;
  const int least = velocity_mode_ ? std::abs(speed) : speed;
  if (!stop && least < s.lower_speed) {
    return "! Motor speed cannot be less than " + std::to_string(s.lower_speed) + " pos/sec";
  }
  if (stop) {
    a.motion.halt(profile(axis), time_s);
    s.speed = 0;
    return "*";
  }
  s.speed = speed;
  if (velocity_mode_) {
    start(axis, speed > 0 ? a.greatest : a.least, time_s);
    a.hit_s = a.motion.rest_s();
  } else if (a.motion.rest_s() > time_s) {
    start(axis, static_cast<int>(std::lround(a.motion.target())), time_s);
  }
  return "*";
}

// Not in motion. What a unit says then is not documented; this is the only refusal seen anywhere.
std::string PtuController::set_parameter(int axis, char what, int value, double time_s) {
  AxisSettings& s = settings_.axes[at(axis)];
  const bool moving = axes_[at(axis)].motion.rest_s() > time_s;
  if (moving || value <= 0) return kIllegal;
  if (what == 'U' && value > config_.max_speed_counts_s) {
    return "! " + axes_[at(axis)].name + " speed cannot exceed " +
           std::to_string(config_.max_speed_counts_s) + " positions/sec";
  }
  int& parameter = what == 'A'   ? s.acceleration
                   : what == 'B' ? s.base_speed
                   : what == 'U' ? s.upper_speed
                                 : s.lower_speed;
  parameter = value;
  return "*";
}

// Without soft limits the axis runs into its mechanical stop and loses nothing but the way beyond.
void PtuController::start(int axis, int target, double time_s) {
  Axis& a = axes_[at(axis)];
  const int reached =
      std::clamp(target, a.least - kHardStopMargin_counts, a.greatest + kHardStopMargin_counts);
  a.slaved.reset();
  a.motion.move(reached, profile(axis), time_s);
  a.hit_s = reached == target ? std::nullopt : std::optional(a.motion.rest_s());
}

void PtuController::start_slaved(double time_s) {
  for (int axis = 0; axis < 2; ++axis) {
    if (const auto target = axes_[at(axis)].slaved) start(axis, *target, time_s);
  }
}

// Tilt, then pan, to both ends; then both to zero. Returns when that is over.
double PtuController::home(double time_s) {
  const double speed_counts_s =
      config_.home_speed_rad_s / radians(config_.resolution_arcsec / 3600.0);
  double end_s = time_s;
  for (const int axis : {1, 0}) {
    Axis& a = axes_[at(axis)];
    PtuAxis::Profile homing = profile(axis);
    homing.speed = speed_counts_s;
    homing.acceleration = 2.0 * speed_counts_s;
    a.slaved.reset();
    a.hit_s.reset();
    for (const int end : {a.least, a.greatest}) {
      a.motion.move(end, homing, end_s);
      end_s = a.motion.rest_s();
      tokens_.push_back({end_s, axis == 0 ? "!P" : "!T"});
    }
    a.motion.move(0.0, homing, end_s);
    if (axis == 0) end_s = std::max(axes_[1].motion.rest_s(), a.motion.rest_s());
  }
  return end_s;
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

void PtuController::forget(double before_s) {
  for (Axis& axis : axes_) axis.motion.forget(before_s);
}

}  // namespace ols::sim
