// The configuration of a station's [gpio].
#pragma once

#include <string>

namespace ols::config {
struct Section;
}
namespace ols::gpio {

struct GpioConfig {
  // "/dev/gpiochip0", or "socket:PATH" for lines served by another process; empty if there is no
  // GPIO.
  std::string chip;
  int led_line = -1;   // -1 if there is none
  int stop_line = -1;  // emergency stop, normally closed, so that a broken wire is a stop
  // The level of the line when the contact is open. False: high (the contact connects to ground,
  // and the line is pulled up). True: low (the contact connects to the supply, and the line is
  // pulled down).
  bool stop_active_low = false;
  double stop_release_s =
      0.05;  // a release counts after it has been stable for this time; a press counts at once
  // The button at the station that re-arms it after an emergency stop; normally open.
  int rearm_line = -1;  // -1 if there is none
  // True: the button connects to ground (pulled up); false: to the supply.
  bool rearm_active_low = true;
  double rearm_hold_s = 1.0;      // the button must be seen open, and then be held for this long
  bool rearm_over_bus = false;    // programs on the bus may re-arm the station, too
  int trigger_line = -1;          // camera trigger, one pulse per frame; -1 if there is none
  double trigger_pulse_s = 1e-3;  // length of the pulse

  bool has_stop() const { return !chip.empty() && stop_line >= 0; }
};

config::Section gpio_section(GpioConfig& config);  // the section [gpio]

}  // namespace ols::gpio
