#include "sim/ptu/setup.h"

#include <algorithm>
#include <array>

#include "sim/ptu/command_text.h"

namespace ols::sim {

namespace {

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

PtuSetup::PtuSetup(const PtuUnitConfig& config)
    : config_(config),
      settings_(factory_settings(config)),
      homes_{config.home_at_power_up, config.home_at_power_up},
      baud_(config.baud),
      baud_at_power_up_(config.baud) {
  settings_.echo = config.echo;
  settings_.feedback = config.verbose ? PtuFeedback::kVerbose : PtuFeedback::kTerse;
  saved_ = settings_;
}

void PtuSetup::power_up() {
  settings_ = saved_;
  selected_ = settings_.unit_id == 0;
  baud_ = baud_at_power_up_;
}

// Saved at once.
void PtuSetup::scan_at_power_up(bool scans) {
  settings_.scan_at_power_up = saved_.scan_at_power_up = scans;
}

std::optional<std::string> PtuSetup::execute(std::string_view command) {
  if (auto answer = toggles(command)) return answer;
  if (auto answer = homing_choice(command)) return answer;
  if (auto answer = keeping(command)) return answer;
  if (auto answer = host_port(command)) return answer;
  if (auto answer = unit_id(command)) return answer;
  if (auto answer = encoder_correction(command)) return answer;
  return step_mode(command);
}

std::optional<std::string> PtuSetup::toggles(std::string_view command) {
  if (command == "E") return settings_.echo ? "* Echoing ON" : "* Echoing OFF";
  if (command == "F") return verbose() ? "* ASCII verbose mode" : "* ASCII terse mode";
  if (command == "EE" || command == "ED") {
    settings_.echo = command == "EE";
  } else if (command == "FV") {
    settings_.feedback = PtuFeedback::kVerbose;
  } else if (command == "FT") {
    settings_.feedback = PtuFeedback::kTerse;
  } else if (command == "FO") {
    settings_.feedback = PtuFeedback::kOff;
  } else {
    return std::nullopt;
  }
  return "*";
}

// Saved at once. On an E-series unit RP and RT home instead: see PtuController.
std::optional<std::string> PtuSetup::homing_choice(std::string_view command) {
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

std::string PtuSetup::homing_speed(int axis, std::string_view wanted) {
  PtuAxisSettings& s = settings_.axes[at(axis)];
  if (wanted.empty()) {
    return star(std::to_string(s.home_speed));
  }
  const auto value = whole_number(wanted);
  if (!value || *value <= 0) return kIllegalArgument;
  s.home_speed = *value;
  return "*";
}

std::optional<std::string> PtuSetup::keeping(std::string_view command) {
  if (command == "DS") {
    saved_ = settings_;
  } else if (command == "DR") {
    settings_ = saved_;
  } else if (command == "DF") {
    settings_ = factory_settings(config_);
  } else {
    return std::nullopt;
  }
  return "*";
}

// @(rate,delay of bytes,T or F: also at power-up). Nothing is connected to the second port.
std::optional<std::string> PtuSetup::host_port(std::string_view command) {
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

// Several units on one line: a unit with an id accepts only `_id` and `_0` until selected.
std::optional<std::string> PtuSetup::unit_id(std::string_view command) {
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

std::optional<std::string> PtuSetup::encoder_correction(std::string_view command) {
  if (!e_series()) return std::nullopt;
  if (command == "CT") {
    return settings_.encoder_correction ? "* Encoder correction is ENABLED"
                                        : "* Encoder correction is DISABLED";
  }
  if (command != "CEC" && command != "CED") return std::nullopt;
  settings_.encoder_correction = command == "CEC";
  return "*";
}

// WP, WT: full, half, quarter, eighth or automatic steps, from the next reset on.
std::optional<std::string> PtuSetup::step_mode(std::string_view command) {
  if (!e_series()) return std::nullopt;
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
    return star(std::string(ptu_axis_name(axis)) + " in " + name + " step mode");
  }
  if (command.size() != 3 || std::string_view("FHQEA").find(command[2]) == std::string_view::npos) {
    return kIllegalArgument;
  }
  mode = command[2];
  return "*";
}

std::string PtuSetup::power(int axis, std::string_view what) {
  PtuAxisSettings& s = settings_.axes[at(axis)];
  const bool hold = what[0] == 'H';
  char& power = hold ? s.hold_power : s.move_power;
  if (what.size() == 1) {
    const std::string name = level(power);
    if (!verbose()) return star(name == "REGULAR" ? "REG" : name);
    return star(std::string(ptu_axis_name(axis)) + " in " + name + (hold ? " hold" : " move") +
                " power mode");
  }
  const std::string_view levels = hold ? "RLO" : "HRL";
  if (what.size() != 2 || levels.find(what[1]) == std::string_view::npos) return kIllegalArgument;
  power = what[1];
  return "*";
}

// A user's range contains zero and lies within the factory's.
std::string PtuSetup::user_limit(int axis, std::string_view what, int factory_limit) {
  PtuAxisSettings& s = settings_.axes[at(axis)];
  const bool low = what[0] == 'N';
  int& limit = low ? s.user_least : s.user_greatest;
  if (what.size() == 2) {
    if (!verbose()) return star(std::to_string(limit));
    return std::string(low ? "* Minimum " : "* Maximum ") + ptu_axis_name(axis) + " position is " +
           std::to_string(limit);
  }
  const auto value = whole_number(what.substr(2));
  if (!value) return kIllegalArgument;
  const bool within =
      low ? *value <= 0 && *value >= factory_limit : *value >= 0 && *value <= factory_limit;
  if (!within) return kIllegalArgument;
  limit = *value;
  return "*";
}

}  // namespace ols::sim
