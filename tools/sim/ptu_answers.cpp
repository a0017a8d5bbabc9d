// What the simulated PTU says: the texts of queries, modes and settings, as in the PTU-D46's manual
// and in transcripts of real units.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "tools/sim/ptu_controller.h"

namespace ols::sim {

namespace {

constexpr const char* kIllegal = "! Illegal Command Entered";
constexpr const char* kVersion =
    "Pan-Tilt Controller v2.12.1d1(C14/E), (C)2003 Directed Perception, Inc., All Rights Reserved";

struct Phrase {  // `before` holds % for the name of the axis
  char what;
  const char* before;
  const char* after;
};

constexpr std::array<Phrase, 11> kPhrases{{
    {'P', "Current % position is ", ""},
    {'O', "Target % position is ", ""},
    {'R', "", " seconds arc per position"},
    {'N', "Minimum % position is ", ""},
    {'X', "Maximum % position is ", ""},
    {'S', "Target % speed is ", " positions/sec"},
    {'D', "Current % speed is ", " positions/sec"},
    {'A', "% acceleration is ", " positions/sec^2"},
    {'B', "Current % base speed is ", " positions/sec"},
    {'U', "Maximum % speed is ", " positions/sec"},
    {'L', "Minimum % speed is ", " positions/sec"},
}};

std::string with_name(std::string text, const std::string& name) {
  const auto place = text.find('%');
  return place == std::string::npos ? text : text.replace(place, 1, name);
}

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

std::string PtuController::query(int axis, char what, double time_s) const {
  const auto phrase = std::find_if(kPhrases.begin(), kPhrases.end(),
                                   [what](const Phrase& p) { return p.what == what; });
  if (phrase == kPhrases.end()) return kIllegal;
  const Axis& a = axes_[at(axis)];
  const AxisSettings& s = settings_.axes[at(axis)];
  char resolution[32];
  std::snprintf(resolution, sizeof resolution, "%.4f", config_.resolution_arcsec);
  const auto number = [&]() -> std::string {
    switch (what) {
      case 'P':
        return std::to_string(std::lround(a.motion.position(time_s)));
      case 'O':
        return std::to_string(a.slaved ? *a.slaved : std::lround(a.motion.target()));
      case 'R':
        return resolution;
      case 'N':
        return std::to_string(a.least);
      case 'X':
        return std::to_string(a.greatest);
      case 'S':
        return std::to_string(s.speed);
      case 'D':
        return std::to_string(std::lround(a.motion.velocity(time_s)));
      case 'A':
        return std::to_string(s.acceleration);
      case 'B':
        return std::to_string(s.base_speed);
      case 'U':
        return std::to_string(s.upper_speed);
      default:
        return std::to_string(s.lower_speed);
    }
  }();
  if (!settings_.verbose) return "* " + number;
  return "* " + with_name(phrase->before, a.name) + number + phrase->after;
}

std::string PtuController::power(int axis, std::string_view what) {
  AxisSettings& s = settings_.axes[at(axis)];
  const bool hold = what[0] == 'H';
  char& power = hold ? s.hold_power : s.move_power;
  if (what.size() == 1) {
    const std::string name = level(power);
    if (!settings_.verbose) return "* " + (name == "REGULAR" ? "REG" : name);
    return "* " + axes_[at(axis)].name + " in " + name + (hold ? " hold" : " move") + " power mode";
  }
  const std::string_view levels = hold ? "RLO" : "HRL";
  if (what.size() != 2 || levels.find(what[1]) == std::string_view::npos) return kIllegal;
  power = what[1];
  return "*";
}

std::optional<std::string> PtuController::mode(std::string_view command, double time_s) {
  if (auto answer = toggles(command)) return answer;
  if (command == "C") {
    if (settings_.verbose) {
      return velocity_mode_ ? "* PTU is in Pure Velocity Mode" : "* PTU is in Independent Mode";
    }
    return velocity_mode_ ? "* p" : "* i";
  }
  if (command == "CI" || command == "CV") {
    const bool velocity = command == "CV";
    if (velocity != velocity_mode_) {
      for (int axis = 0; axis < 2; ++axis) {
        axes_[at(axis)].motion.halt(profile(axis), time_s);
        axes_[at(axis)].hit_s.reset();
        int& speed = settings_.axes[at(axis)].speed;
        speed = std::max(std::abs(speed), settings_.axes[at(axis)].lower_speed);
      }
    }
    velocity_mode_ = velocity;
    return "*";
  }
  if (command == "I") {
    immediate_ = true;
    start_slaved(time_s);
    return "*";
  }
  if (command == "S") {
    immediate_ = false;
    return "*";
  }
  if (command == "V") return std::string("* ") + kVersion;
  if (command == "O") return "* Input 30 VDC @ 86 degF";
  if (command.size() == 2 && command[0] == 'D') return defaults(command);
  return std::nullopt;
}

// Switches that have two positions and can be asked for.
std::optional<std::string> PtuController::toggles(std::string_view command) {
  if (command == "E") return settings_.echo ? "* Echoing ON" : "* Echoing OFF";
  if (command == "F") return settings_.verbose ? "* ASCII verbose mode" : "* ASCII terse mode";
  if (command == "L") {
    return limits_ ? "* Limit bounds are ENABLED (soft limits enabled)"
                   : "* Limit bounds are DISABLED (hard limits only: use care)";
  }
  if (command == "EE" || command == "ED") {
    settings_.echo = command == "EE";
  } else if (command == "FV" || command == "FT") {
    settings_.verbose = command == "FV";
  } else if (command == "LE" || command == "LD") {
    limits_ = command == "LE";
  } else {
    // On a D46 RP, RT, RE and RD choose the axes to be homed at the next power-up, and move
    // nothing.
    const bool homing = command == "RP" || command == "RT" || command == "RE" || command == "RD";
    if (!homing) return std::nullopt;
  }
  return "*";
}

std::optional<std::string> PtuController::halts(std::string_view command, double time_s) {
  if (command != "H" && command != "HP" && command != "HT") return std::nullopt;
  for (int axis = 0; axis < 2; ++axis) {
    if (command == (axis == 0 ? "HT" : "HP")) continue;
    Axis& a = axes_[at(axis)];
    a.slaved.reset();
    a.hit_s.reset();
    a.motion.halt(profile(axis), time_s);
  }
  return "*";
}

std::string PtuController::defaults(std::string_view command) {
  if (command == "DS") {
    saved_ = settings_;
  } else if (command == "DR") {
    settings_ = saved_;
  } else if (command == "DF") {
    settings_ = PtuController(config_, 0.0).settings_;
    settings_.echo = settings_.verbose = true;
  } else {
    return kIllegal;
  }
  return "*";
}

// @(rate,delay,flag)
std::string PtuController::change_baud(std::string_view command) {
  constexpr std::array<int, 8> kRates{600, 1200, 2400, 4800, 9600, 19200, 38400, 115200};
  const char* begin = command.data() + 2;
  int rate = 0;
  const auto [end, error] = std::from_chars(begin, command.data() + command.size(), rate);
  const bool closed = error == std::errc{} && *end == ',' && command.back() == ')';
  if (!closed || std::find(kRates.begin(), kRates.end(), rate) == kRates.end()) return kIllegal;
  baud_ = rate;
  return "*";
}

}  // namespace ols::sim
