// The blink patterns of the status LED. Pure.
#pragma once

namespace ols::gpio {

enum class LedPattern {
  kOff,
  kStarting,   // slow even blink
  kReady,      // short flash every two seconds
  kTracking,   // steady
  kTrouble,    // fast blink: an alarm holds
  kEmergency,  // double flash
};

// All patterns are made of slots of this length.
inline constexpr double kLedSlot_s = 0.1;

// Whether the LED is lit `time_s` after the pattern began.
bool led_lit(LedPattern pattern, double time_s);

}  // namespace ols::gpio
