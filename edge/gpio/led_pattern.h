// The blink patterns of the status LED. Pure.
#pragma once

namespace ols::gpio {

enum class LedPattern {
  kOff,
  kStarting,   // slow blink, on as long as off
  kReady,      // short flash every two seconds
  kTracking,   // steady
  kTrouble,    // fast blink: there is an alarm
  kEmergency,  // double flash
};

// All patterns consist of slots of this length; the LED changes only between slots.
inline constexpr double kLedSlot_s = 0.1;

// Whether the LED is lit. `time_s`: time since the pattern began.
bool led_lit(LedPattern pattern, double time_s);

}  // namespace ols::gpio
