// The station's GPIO: a status LED, the inputs of emergency stop and re-arming, an optional camera
// trigger. A thread waits for the edges. gpio_lines.h hides libgpiod.
//
// The emergency stop in software only assists a hardware stop that cuts the power of the motors
// (docs/field-guide.md).
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "edge/device/device_report.h"
#include "edge/gpio/led_pattern.h"

namespace ols::config {
struct Section;
}
namespace ols::gpio {

struct GpioConfig {
  std::string chip;    // "/dev/gpiochip0", or "socket:PATH" for lines served by another
                       // process; empty: no GPIO
  int led_line = -1;   // -1: none
  int stop_line = -1;  // emergency stop; normally closed: a broken wire is a stop
  // The level of the opened contact. False: high (it closes to ground, and the line is pulled up).
  // True: low (it closes to the supply, and the line is pulled down).
  bool stop_active_low = false;
  double stop_release_s = 0.05;  // a release counts after this stable time; a press at once
  // The button at the station that re-arms it after an emergency stop; normally open.
  int rearm_line = -1;            // -1: none
  bool rearm_active_low = true;   // closes to ground (pulled up); false: to the supply
  double rearm_hold_s = 1.0;      // the button must be seen open, and then be held this long
  bool rearm_over_bus = false;    // any program on the bus may re-arm the station, too
  int trigger_line = -1;          // camera trigger, one pulse per frame
  double trigger_pulse_s = 1e-3;  // length of the pulse

  bool has_stop() const { return !chip.empty() && stop_line >= 0; }
};

config::Section gpio_section(GpioConfig& config);  // [gpio]

class Gpio {
 public:
  // `on_stop(pressed)` is called from Gpio's thread at every edge of the emergency stop, and once
  // for its first level. With a stop_line, missing or unreadable lines count as pressed.
  // `on_rearm()` is called each time the button was held while the stop is not pressed.
  Gpio(const GpioConfig& config, std::function<void(bool pressed)> on_stop,
       std::function<void()> on_rearm = {});
  ~Gpio();
  Gpio(const Gpio&) = delete;
  Gpio& operator=(const Gpio&) = delete;

  // Call from any thread; none of these waits for the device.
  void show(LedPattern pattern);
  void trigger();  // a pulse on trigger_line
  // True also while the first level is unknown. False without a stop_line.
  bool stop_pressed() const;
  device::DeviceReport report() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::gpio
