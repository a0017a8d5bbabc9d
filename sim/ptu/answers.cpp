#include "sim/ptu/answers.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "conditions/printed.h"
#include "sim/ptu/command_text.h"

namespace ols::sim {

namespace {

// The resolution that a D46 assumes until it has found its gears at a reset: the coarsest of the
// family.
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

std::string PtuAnswers::query(int axis, char what, double time_s) const {
  const auto phrase = std::find_if(kPhrases.begin(), kPhrases.end(),
                                   [what](const Phrase& p) { return p.what == what; });
  if (!setup_.verbose()) return star(number(axis, what, time_s));
  return star(with_name(phrase->before, ptu_axis_name(axis)) + number(axis, what, time_s) +
              phrase->after);
}

std::string PtuAnswers::number(int axis, char what, double time_s) const {
  const PtuAxisSettings& s = setup_.settings().axes[at(axis)];
  const double arcsec = motion_.homed(axis) || e_series()
                            ? config_.resolution_arcsec * motion_.steps_a_count(axis)
                            : kUnknownGears_arcsec;
  switch (what) {
    case 'P':
      return rounded(motion_.position(axis, time_s));
    case 'O':
      return rounded(motion_.target(axis));
    case 'R':
      return printed("%.*f", e_series() ? 6 : 4, arcsec);
    case 'N':
      return std::to_string(motion_.least(axis));
    case 'X':
      return std::to_string(motion_.greatest(axis));
    case 'S':
      return std::to_string(s.speed);
    case 'D':
      return rounded(motion_.velocity(axis, time_s));
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

std::string PtuAnswers::firmware() const {
  if (!config_.firmware.empty()) return config_.firmware;
  return e_series() ? "3.3.0" : "2.14.0";
}

// From 2.12.11 on.
bool PtuAnswers::has_presets() const {
  std::array<int, 3> version{};
  static_cast<void>(
      std::sscanf(firmware().c_str(), "%d.%d.%d", &version[0], &version[1], &version[2]));
  return version >= std::array<int, 3>{2, 12, 11};
}

std::string PtuAnswers::version() const {
  return std::string("v") + firmware() +
         (e_series() ? ", (C)2010-2011 FLIR Commercial Systems, Inc., All Rights Reserved"
                     : "(C14/E), (C)2003 Directed Perception, Inc., All Rights Reserved");
}

std::string PtuAnswers::banner() const {
  if (!setup_.selected()) return {};
  return std::string("\r\n### PAN-TILT CONTROLLER\r\n### ") + version() + "\r\n" +
         (e_series() ? "Initializing..." : "");
}

std::optional<std::string> PtuAnswers::information(std::string_view command) const {
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
