#include "edge/gpio/led_pattern.h"

#include <cmath>
#include <string_view>

namespace ols::gpio {
namespace {

// One period, a character a slot: '#' lit.
std::string_view period(LedPattern pattern) {
  switch (pattern) {
    case LedPattern::kOff:
      return ".";
    case LedPattern::kStarting:
      return "##########..........";
    case LedPattern::kReady:
      return "#...................";
    case LedPattern::kTracking:
      return "#";
    case LedPattern::kTrouble:
      return "##..";
    case LedPattern::kEmergency:
      return "#.#.......";
  }
  return ".";
}

}  // namespace

bool led_lit(LedPattern pattern, double time_s) {
  const std::string_view slots = period(pattern);
  // Shifted slightly into the slot, so that rounding does not assign its start to the slot before.
  const auto slot = static_cast<long>(std::floor(time_s / kLedSlot_s + 1e-6));
  const auto length = static_cast<long>(slots.size());
  return slots[static_cast<std::size_t>((slot % length + length) % length)] == '#';
}

}  // namespace ols::gpio
