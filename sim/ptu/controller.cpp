#include "sim/ptu/controller.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "sim/ptu/command_text.h"

namespace ols::sim {

namespace {

constexpr double kClock_hz = 90e6;  // of an E-series unit's time stamps

std::string upper(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return result;
}

bool one_of(std::string_view letters, char letter) {
  return letters.find(letter) != std::string_view::npos;
}

}  // namespace

PtuController::PtuController(const PtuUnitConfig& config, double power_up_s)
    : config_(config),
      setup_(config),
      motion_(config, setup_.settings(), power_up_s),
      scan_(setup_, motion_),
      presets_(motion_),
      answers_(config, setup_, motion_) {}

PtuAnswer PtuController::power_up(double time_s) {
  setup_.power_up();
  motion_.power_up();
  scan_.power_up();
  PtuAnswer answer{"*", home(setup_.homes(0), setup_.homes(1), time_s)};
  if (setup_.settings().scan_at_power_up) scan_.start({}, answer.ready_s);
  if (!setup_.selected()) answer.text.clear();
  return answer;
}

PtuAnswer PtuController::power_cycle(double time_s) {
  motion_.power_off(time_s);
  return power_up(time_s);
}

PtuAnswer PtuController::execute(std::string_view command_text, double time_s) {
  PtuAnswer answer = dispatch(upper(command_text), time_s);
  if (!talks()) answer.text.clear();
  return answer;
}

PtuAnswer PtuController::dispatch(const std::string& command, double time_s) {
  if (!setup_.selected() && command[0] != '_') return {"", time_s};
  if (const auto answer = blocking(command, time_s)) return *answer;
  if (const auto answer = at_once(command, time_s)) return {*answer, time_s};
  const bool of_axis = command.size() >= 2 && (command[0] == 'P' || command[0] == 'T');
  if (!of_axis) return {kIllegalCommand, time_s};
  const bool slow = one_of("ABUL", command[1]);
  const bool sets = command.size() > 2;
  return {axis_command(command[0] == 'P' ? 0 : 1, command.substr(1), time_s),
          time_s + (slow && sets ? config_.parameter_set_s : 0.0)};
}

// The answer at the end of the motion.
std::optional<PtuAnswer> PtuController::blocking(std::string_view command, double time_s) {
  if (command == "A") {
    motion_.start_slaved(time_s);
    return PtuAnswer{"*", std::max({time_s, motion_.rest_s(0), motion_.rest_s(1)})};
  }
  if (command == "R") return PtuAnswer{"*", home(true, true, time_s)};
  if (!e_series()) return std::nullopt;
  // On a D46 these select the axes that home at power-up.
  if (command == "RP") return PtuAnswer{"*", home(true, false, time_s)};
  if (command == "RT") return PtuAnswer{"*", home(false, true, time_s)};
  if (command != "RS") return std::nullopt;
  scan_.end(0);
  scan_.end(1);
  return PtuAnswer{"*", motion_.home_together(time_s)};
}

double PtuController::home(bool pan, bool tilt, double time_s) {
  if (pan) scan_.end(0);
  if (tilt) scan_.end(1);
  return motion_.home(pan, tilt, time_s);
}

// Commands for both axes.
std::optional<std::string> PtuController::at_once(std::string_view command, double time_s) {
  if (auto answer = motion_.execute(command, setup_.verbose(), time_s)) return answer;
  if (auto answer = setup_.execute(command)) return answer;
  if (auto answer = answers_.information(command)) return answer;
  if (auto answer = scan_.execute(command, e_series(), time_s)) return answer;
  if (answers_.has_presets()) {
    if (auto answer = presets_.execute(command, time_s)) return answer;
  }
  if (!e_series()) return std::nullopt;
  if (auto answer = clock(command, time_s)) return answer;
  return both_axes(command, time_s);
}

// `command` without the letter of the axis.
std::string PtuController::axis_command(int axis, std::string_view command, double time_s) {
  const char what = command[0];
  const std::string_view rest = command.substr(1);
  if (what == 'H' || what == 'M') return setup_.power(axis, command);
  if (!one_of("PORNXSDABUL", what)) return kIllegalCommand;
  if (e_series() && one_of("PONX", what) && !motion_.homed(axis)) return kAxisError;
  if (rest.empty()) return answers_.query(axis, what, time_s);
  if (e_series() && (what == 'N' || what == 'X') && rest[0] == 'U') {
    return setup_.user_limit(
        axis, command, what == 'N' ? motion_.factory_least(axis) : motion_.factory_greatest(axis));
  }
  const auto value = whole_number(rest);
  return value ? set_axis(axis, what, *value, time_s) : kIllegalArgument;
}

std::string PtuController::set_axis(int axis, char what, int value, double time_s) {
  const auto now = [](double counts) { return static_cast<int>(std::lround(counts)); };
  switch (what) {
    case 'P':
      return motion_.set_position(axis, value, time_s);
    case 'O':
      return motion_.set_position(axis, now(motion_.position(axis, time_s)) + value, time_s);
    case 'S':
      return motion_.set_speed(axis, value, time_s);
    case 'D':
      return motion_.set_speed(axis, now(motion_.velocity(axis, time_s)) + value, time_s);
    case 'A':
    case 'B':
    case 'U':
    case 'L':
      return motion_.set_parameter(axis, what, value, time_s);
    default:
      return kIllegalArgument;
  }
}

std::optional<std::string> PtuController::clock(std::string_view command, double time_s) const {
  if (command == "CNF") return star(std::to_string(std::llround(kClock_hz)));
  if (command == "CNT") return star(std::to_string(std::llround(kClock_hz * time_s)));
  return std::nullopt;
}

// B: queries or sets positions and speeds of both axes; BT: with a time stamp appended [ms].
std::optional<std::string> PtuController::both_axes(std::string_view command, double time_s) {
  if (command == "B" || command == "BT") {
    if (!motion_.homed(0) || !motion_.homed(1)) return kAxisError;
    return report_both(command == "BT", time_s);
  }
  if (command.empty() || command[0] != 'B') return std::nullopt;
  const auto wanted = whole_numbers(command.substr(1));
  if (!wanted) return std::nullopt;
  if (wanted->size() != 4) return kIllegalArgument;
  if (!motion_.homed(0) || !motion_.homed(1)) return kAxisError;
  for (const int axis : {0, 1}) {
    const std::string speed = motion_.set_speed(axis, (*wanted)[2 + at(axis)], time_s);
    if (speed != "*") return speed;
  }
  for (const int axis : {0, 1}) {
    const std::string position = motion_.set_position(axis, (*wanted)[at(axis)], time_s);
    if (position != "*") return position;
  }
  return "*";
}

std::string PtuController::report_both(bool with_time, double time_s) const {
  std::string text = "*";
  for (const char what : {'P', 'D'}) {
    text += what == 'P' ? " P(" : " S(";
    text += answers_.number(0, what, time_s) + "," + answers_.number(1, what, time_s) + ")";
  }
  if (with_time) text.append(" ").append(std::to_string(std::lround(1e3 * time_s)));
  return text;
}

std::vector<PtuToken> PtuController::take_tokens(double time_s) {
  std::vector<PtuToken> due = motion_.take_tokens(time_s);
  if (!setup_.selected()) due.clear();
  return due;
}

}  // namespace ols::sim
