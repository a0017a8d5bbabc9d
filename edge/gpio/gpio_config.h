// The configuration of a station's GPIO lines.
#pragma once

#include <string>

namespace ols::config {
struct Section;
}
namespace ols::gpio {

struct GpioConfig {
  // "/dev/gpiochip0", or "socket:PATH" for lines that another process serves (gpio_lines.h); empty
  // if there is no GPIO.
  std::string chip;
  int led_line = -1;  // -1 if there is none
  // Emergency stop; -1 if there is none; normally closed, so that a broken wire acts as a stop.
  int stop_line = -1;
  // The level of stop_line while the stop is pressed, that is, while its contact is open. False:
  // high, because the contact connects to ground and the line is pulled up. True: low, because the
  // contact connects to the supply and the line is pulled down.
  bool stop_active_low = false;
  // A release counts when it has been stable for this time; a press counts at once.
  double stop_release_s = 0.05;
  // The button that re-arms the station after an emergency stop; normally open.
  int rearm_line = -1;  // -1 if there is none
  // True: the button connects to ground, and the line is pulled up. False: the button connects to
  // the supply, and the line is pulled down.
  bool rearm_active_low = true;
  double rearm_hold_s = 1.0;      // the button must be held for this time, after it was seen open
  bool rearm_over_bus = false;    // true: programs on the bus may re-arm the station, too
  int trigger_line = -1;          // camera trigger, one pulse per frame; -1 if there is none
  double trigger_pulse_s = 1e-3;  // length of the pulse

  bool has_stop() const { return !chip.empty() && stop_line >= 0; }
};

config::Section gpio_section(GpioConfig& config);  // the section [gpio]

}  // namespace ols::gpio
