// What the simulated PTU says to queries: the texts of the PTU-D46's manual and of transcripts of
// real units.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "sim/ptu_controller.h"

namespace ols::sim {

namespace {

// What a D46 takes its resolution for as long as it has not found its gears at a reset: the
// coarsest of the family.
constexpr double kUnknownGears_arcsec = 185.1428;

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
    {'A', "% acceleration is ", " positions/sec/sec"},
    {'B', "Current % base speed is ", " positions/sec"},
    {'U', "Maximum % speed is ", " positions/sec"},
    {'L', "Minimum % speed is ", " positions/sec"},
}};

std::string with_name(std::string text, const std::string& name) {
  const auto place = text.find('%');
  return place == std::string::npos ? text : text.replace(place, 1, name);
}

std::string rounded(double value) { return std::to_string(std::lround(value)); }

}  // namespace

std::string star(std::string_view text) {
  std::string answer = "* ";
  answer += text;
  return answer;
}

// `command` without the letter of the axis.
std::string PtuController::axis_command(int axis, std::string_view command, double time_s) {
  const char what = command[0];
  const std::string_view rest = command.substr(1);
  if (what == 'H' || what == 'M') return power(axis, command);
  if (std::string_view("PORNXSDABUL").find(what) == std::string_view::npos) return kIllegalCommand;
  const bool of_place = std::string_view("PONX").find(what) != std::string_view::npos;
  if (e_series() && of_place && !axes_[at(axis)].homed) return kAxisError;
  if (rest.empty()) return query(axis, what, time_s);
  if (e_series() && (what == 'N' || what == 'X') && rest[0] == 'U') {
    return user_limit(axis, command);
  }
  const auto value = whole_number(rest);
  if (!value) return kIllegalArgument;
  const Axis& a = axes_[at(axis)];
  switch (what) {
    case 'P':
      return set_position(axis, *value, time_s);
    case 'O':
      return set_position(
          axis, static_cast<int>(std::lround(counts(a, a.motion.position(time_s)))) + *value,
          time_s);
    case 'S':
      return set_speed(axis, *value, time_s);
    case 'D':
      return set_speed(
          axis, static_cast<int>(std::lround(a.motion.velocity(time_s) / a.divisor)) + *value,
          time_s);
    case 'A':
    case 'B':
    case 'U':
    case 'L':
      return set_parameter(axis, what, *value, time_s);
    default:
      return kIllegalArgument;
  }
}

std::string PtuController::query(int axis, char what, double time_s) const {
  const auto phrase = std::find_if(kPhrases.begin(), kPhrases.end(),
                                   [what](const Phrase& p) { return p.what == what; });
  if (!verbose()) return star(number(axis, what, time_s));
  return star(with_name(phrase->before, axes_[at(axis)].name) + number(axis, what, time_s) +
              phrase->after);
}

std::string PtuController::number(int axis, char what, double time_s) const {
  const Axis& a = axes_[at(axis)];
  const AxisSettings& s = settings_.axes[at(axis)];
  char resolution[32];
  const double arcsec =
      a.homed || e_series() ? config_.resolution_arcsec * a.divisor : kUnknownGears_arcsec;
  std::snprintf(resolution, sizeof resolution, e_series() ? "%.6f" : "%.4f", arcsec);
  switch (what) {
    case 'P':
      return rounded(counts(a, a.motion.position(time_s)));
    case 'O':
      return rounded(counts(a, a.slaved.value_or(a.motion.target())));
    case 'R':
      return resolution;
    case 'N':
      return std::to_string(least(axis));
    case 'X':
      return std::to_string(greatest(axis));
    case 'S':
      return std::to_string(s.speed);
    case 'D':
      return rounded(a.motion.velocity(time_s) / a.divisor);
    case 'A':
      return std::to_string(s.acceleration);
    case 'B':
      return std::to_string(s.base_speed);
    case 'U':
      return std::to_string(s.upper_speed);
    default:
      return std::to_string(s.lower_speed);
  }
}

// Both wordings are of real units.
std::string PtuController::refuse_speed(int axis, int fastest) const {
  return std::string("! ") + axes_[at(axis)].name + " speed cannot exceed " +
         std::to_string(fastest) + (e_series() ? " positions/sec" : " pos/sec");
}

std::string PtuController::firmware() const {
  if (!config_.firmware.empty()) return config_.firmware;
  return e_series() ? "3.3.0" : "2.14.0";
}

// From 2.12.11 on.
bool PtuController::has_presets() const {
  std::array<int, 3> version{};
  static_cast<void>(
      std::sscanf(firmware().c_str(), "%d.%d.%d", &version[0], &version[1], &version[2]));
  return version >= std::array<int, 3>{2, 12, 11};
}

std::string PtuController::version() const {
  return std::string("v") + firmware() +
         (e_series() ? ", (C)2010-2011 FLIR Commercial Systems, Inc., All Rights Reserved"
                     : "(C14/E), (C)2003 Directed Perception, Inc., All Rights Reserved");
}

std::string PtuController::banner() const {
  if (!selected_) return {};
  return std::string("\r\n### PAN-TILT CONTROLLER\r\n### ") + version() + "\r\n" +
         (e_series() ? "Initializing..." : "");
}

std::optional<std::string> PtuController::information(std::string_view command, double) {
  if (command == "V") return std::string("* Pan-Tilt Controller ") + version();
  // Supply, and the temperatures of head, pan and tilt motor in degrees Fahrenheit.
  if (command == "O") return e_series() ? "* 13.2,99,97,104" : "* Input 30 VDC @ 86 degF";
  if (command == "?") {
    return "PP TP PO TO PS TS PD TD PA TA PB TB PU TU PL TL PR TR PN TN PX TX\r\n"
           "I S A H L C M X R D E F V O P U\r\n*";
  }
  if (!e_series()) return std::nullopt;
  if (command == "VV") return star(firmware());
  if (command == "VM") return "* PTU-E46-70";
  if (command == "VS") return "* 46000001";
  if (command == "NI") return "* IP: 0.0.0.0";
  if (command == "NM") return "* Netmask: 255.255.255.0";
  if (command == "NG") return "* Gateway: 0.0.0.0";
  return std::nullopt;
}

}  // namespace ols::sim
