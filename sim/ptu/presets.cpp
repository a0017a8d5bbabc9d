#include "sim/ptu/presets.h"

#include <cmath>

#include "sim/ptu/command_text.h"

namespace ols::sim {

namespace {

constexpr int kGreatestPreset = 32;  // PTU-D300's manual, 4.3.11

}  // namespace

std::optional<std::string> PtuPresets::execute(std::string_view command, double time_s) {
  const bool known = command.size() >= 2 && command[0] == 'X' &&
                     std::string_view("SGC").find(command[1]) != std::string_view::npos;
  if (!known) return std::nullopt;
  if (command == "XC") {  // as a public driver sends it
    places_.clear();
    return "*";
  }
  const auto index = whole_number(command.substr(2));
  if (!index || *index < 0 || *index > kGreatestPreset) return kIllegalArgument;
  if (command[1] == 'C') {
    places_.erase(*index);
    return "*";
  }
  if (command[1] == 'S') {
    places_[*index] = {static_cast<int>(std::lround(motion_.position(0, time_s))),
                       static_cast<int>(std::lround(motion_.position(1, time_s)))};
    return "*";
  }
  const auto place = places_.find(*index);
  if (place == places_.end()) return kIllegalArgument;
  const std::string pan = motion_.set_position(0, place->second.first, time_s);
  return pan == "*" ? motion_.set_position(1, place->second.second, time_s) : pan;
}

}  // namespace ols::sim
