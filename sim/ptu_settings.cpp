// The simulated PTU's modes and settings: what is switched, chosen and kept.
#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/angles.h"
#include "sim/ptu_controller.h"

namespace ols::sim {

namespace {

constexpr double kClock_hz = 90e6;  // of an E-series unit's time stamps

const char* level(char power) {
  switch (power) {
    case 'H':
      return "HIGH";
    case 'L':
      return "LOW";
    case 'O':
      return "OFF";
    default:
      return "REGULAR";
  }
}

}  // namespace

PtuController::Settings PtuController::factory_settings() const {
  const auto home_speed = static_cast<int>(
      std::lround(config_.home_speed_rad_s / radians(config_.resolution_arcsec / 3600.0)));
  const auto axis = [this, home_speed](int least_counts, int greatest_counts) {
    return AxisSettings{1000,
                        config_.acceleration_counts_s2,
                        config_.base_speed_counts_s,
                        config_.max_speed_counts_s,
                        config_.min_speed_counts_s,
                        'R',
                        'R',
                        'E',
                        least_counts,
                        greatest_counts,
                        home_speed};
  };
  return {true,
          Feedback::kVerbose,
          {axis(config_.pan_min_counts, config_.pan_max_counts),
           axis(config_.tilt_min_counts, config_.tilt_max_counts)},
          0,
          false,
          false};
}

std::optional<std::string> PtuController::modes(std::string_view command, double time_s) {
  if (command == "C") {
    if (e_series()) {  // tersely, too
      return velocity_mode_ ? "* Pure Velocity speed control mode"
                            : "* Independent speed control mode";
    }
    if (!verbose()) return velocity_mode_ ? "* p" : "* i";
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

std::optional<std::string> PtuController::toggles(std::string_view command, double) {
  if (command == "E") return settings_.echo ? "* Echoing ON" : "* Echoing OFF";
  if (command == "F") return verbose() ? "* ASCII verbose mode" : "* ASCII terse mode";
  if (command == "EE" || command == "ED") {
    settings_.echo = command == "EE";
  } else if (command == "FV") {
    settings_.feedback = Feedback::kVerbose;
  } else if (command == "FT") {
    settings_.feedback = Feedback::kTerse;
  } else if (command == "FO") {
    settings_.feedback = Feedback::kOff;
  } else {
    return std::nullopt;
  }
  return "*";
}

std::optional<std::string> PtuController::limit_modes(std::string_view command, double) {
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

std::optional<std::string> PtuController::halts(std::string_view command, double time_s) {
  if (command != "H" && command != "HP" && command != "HT") return std::nullopt;
  if (command != "HT") stop(0, time_s);
  if (command != "HP") stop(1, time_s);
  return "*";
}

// Kept at once. On an E-series unit RP and RT home instead: see blocking().
std::optional<std::string> PtuController::homing_choice(std::string_view command, double) {
  if (e_series() && command == "RQ") {
    if (homes_[0]) return homes_[1] ? "* E" : "* P";
    return homes_[1] ? "* T" : "* D";
  }
  if (e_series() && (command.starts_with("RPS") || command.starts_with("RTS"))) {
    return homing_speed(command[1] == 'P' ? 0 : 1, command.substr(3));
  }
  const bool chosen = command == "RP" || command == "RT" || command == "RE" || command == "RD";
  if (!chosen) return std::nullopt;
  homes_ = {command == "RP" || command == "RE", command == "RT" || command == "RE"};
  return "*";
}

std::string PtuController::homing_speed(int axis, std::string_view wanted) {
  AxisSettings& s = settings_.axes[at(axis)];
  if (wanted.empty()) {
    return star(std::to_string(s.home_speed));
  }
  const auto value = whole_number(wanted);
  if (!value || *value <= 0) return kIllegalArgument;
  s.home_speed = *value;
  return "*";
}

std::optional<std::string> PtuController::keeping(std::string_view command, double) {
  if (command == "DS") {
    saved_ = settings_;
  } else if (command == "DR") {
    settings_ = saved_;
  } else if (command == "DF") {
    settings_ = factory_settings();
  } else {
    return std::nullopt;
  }
  return "*";
}

// @(rate,delay of bytes,T or F: also at power-up). The second port has nobody at its other end.
std::optional<std::string> PtuController::host_port(std::string_view command, double) {
  constexpr std::array<int, 9> kRates{600, 1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200};
  if (command == "CHA" || command == "CHB") return "*";
  const bool other = command.starts_with("@A(") || command.starts_with("@B(");
  if (!other && !command.starts_with("@(")) return std::nullopt;
  const std::string_view inside = command.substr(other ? 3 : 2);
  const std::size_t flag = inside.rfind(',');
  const auto numbers = whole_numbers(inside.substr(0, flag));
  const bool shaped = flag != std::string_view::npos && numbers && numbers->size() == 2 &&
                      (inside.substr(flag) == ",T)" || inside.substr(flag) == ",F)");
  if (!shaped || std::find(kRates.begin(), kRates.end(), numbers->front()) == kRates.end()) {
    return kIllegalArgument;
  }
  if (other) return "*";
  baud_ = numbers->front();
  if (inside[flag + 1] == 'T') baud_at_power_up_ = baud_;
  return "*";
}

// Several units on one line: one that has an id listens to `_id` and `_0` only, until selected.
std::optional<std::string> PtuController::unit_id(std::string_view command, double) {
  if (command.empty() || (command[0] != '_' && command[0] != 'U')) return std::nullopt;
  if (command == "U") {
    return std::string(verbose() ? "* Unit ID is " : "* ") + std::to_string(settings_.unit_id);
  }
  const auto id = whole_number(command.substr(1));
  if (!id || *id < 0 || *id > 127) return selected_ ? kIllegalArgument : "";
  if (command[0] == 'U') {
    settings_.unit_id = *id;
  } else {
    selected_ = *id == 0 || *id == settings_.unit_id;
  }
  return "*";
}

std::string PtuController::power(int axis, std::string_view what) {
  AxisSettings& s = settings_.axes[at(axis)];
  const bool hold = what[0] == 'H';
  char& power = hold ? s.hold_power : s.move_power;
  if (what.size() == 1) {
    const std::string name = level(power);
    if (!verbose()) return star(name == "REGULAR" ? "REG" : name);
    return star(axes_[at(axis)].name + " in " + name + (hold ? " hold" : " move") + " power mode");
  }
  const std::string_view levels = hold ? "RLO" : "HRL";
  if (what.size() != 2 || levels.find(what[1]) == std::string_view::npos) return kIllegalArgument;
  power = what[1];
  return "*";
}

std::optional<std::string> PtuController::e_series_only(std::string_view command, double time_s) {
  if (!e_series()) return std::nullopt;
  if (auto answer = step_mode(command)) return answer;
  if (auto answer = move_both(command, time_s)) return answer;
  if (command == "IQ") return immediate_ ? "* I" : "* S";
  if (command == "CT") {
    return settings_.encoder_correction ? "* Encoder correction is ENABLED"
                                        : "* Encoder correction is DISABLED";
  }
  if (command == "CEC" || command == "CED") {
    settings_.encoder_correction = command == "CEC";
    return "*";
  }
  if (command == "CNF") return star(std::to_string(std::llround(kClock_hz)));
  if (command == "CNT") return star(std::to_string(std::llround(kClock_hz * time_s)));
  return std::nullopt;
}

// WP, WT: full, half, quarter, eighth or automatic steps, from the next reset on.
std::optional<std::string> PtuController::step_mode(std::string_view command) {
  if (!command.starts_with("WP") && !command.starts_with("WT")) return std::nullopt;
  const int axis = command[1] == 'P' ? 0 : 1;
  char& mode = settings_.axes[at(axis)].step_mode;
  if (command.size() == 2) {
    if (!verbose()) return star(std::string(1, mode));
    const char* name = mode == 'F'   ? "FULL"
                       : mode == 'H' ? "HALF"
                       : mode == 'Q' ? "QUARTER"
                       : mode == 'E' ? "EIGHTH"
                                     : "AUTO";
    return star(axes_[at(axis)].name + " in " + name + " step mode");
  }
  if (command.size() != 3 || std::string_view("FHQEA").find(command[2]) == std::string_view::npos) {
    return kIllegalArgument;
  }
  mode = command[2];
  return "*";
}

// B: positions and speeds of both axes, asked for or set; BT: with a time stamp behind them [ms].
std::optional<std::string> PtuController::move_both(std::string_view command, double time_s) {
  if (command == "B" || command == "BT") {
    if (!axes_[0].homed || !axes_[1].homed) return kAxisError;
    std::string text = "*";
    for (const char what : {'P', 'D'}) {
      text += what == 'P' ? " P(" : " S(";
      text += number(0, what, time_s) + "," + number(1, what, time_s) + ")";
    }
    if (command == "BT") text.append(" ").append(std::to_string(std::lround(1e3 * time_s)));
    return text;
  }
  if (command.empty() || command[0] != 'B') return std::nullopt;
  const auto wanted = whole_numbers(command.substr(1));
  if (!wanted) return std::nullopt;
  if (wanted->size() != 4) return kIllegalArgument;
  if (!axes_[0].homed || !axes_[1].homed) return kAxisError;
  for (const int axis : {0, 1}) {
    const std::string speed = set_speed(axis, (*wanted)[2 + at(axis)], time_s);
    if (speed != "*") return speed;
  }
  for (const int axis : {0, 1}) {
    const std::string position = set_position(axis, (*wanted)[at(axis)], time_s);
    if (position != "*") return position;
  }
  return "*";
}

// `what`: NU or XU, with or without a value. A user's range holds zero and lies within the
// factory's.
std::string PtuController::user_limit(int axis, std::string_view what) {
  AxisSettings& s = settings_.axes[at(axis)];
  const Axis& a = axes_[at(axis)];
  const bool low = what[0] == 'N';
  int& limit = low ? s.user_least : s.user_greatest;
  if (what.size() == 2) {
    if (!verbose()) return star(std::to_string(limit));
    return std::string(low ? "* Minimum " : "* Maximum ") + a.name + " position is " +
           std::to_string(limit);
  }
  const auto value = whole_number(what.substr(2));
  if (!value) return kIllegalArgument;
  const bool within = low ? *value <= 0 && *value >= a.least / a.divisor
                          : *value >= 0 && *value <= a.greatest / a.divisor;
  if (!within) return kIllegalArgument;
  limit = *value;
  return "*";
}

}  // namespace ols::sim
