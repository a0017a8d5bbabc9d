// The station's GPIO: a status LED, the emergency stop input, an optional camera trigger. A thread
// of its own waits for the edges. libgpiod stays behind edge/gpio/gpio_lines.h.
//
// The emergency stop in software only assists a hardware stop that takes the power off the motors;
// docs/operations.md says so.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "base/toml_config.h"
#include "edge/device_report.h"

namespace ols {

struct GpioConfig {
  std::string chip;    // "/dev/gpiochip0", or "socket:PATH" for lines served by another
                       // process; empty: the station has none
  int led_line = -1;   // -1: none
  int stop_line = -1;  // emergency stop; normally closed: a broken wire is a stop
  bool stop_active_low = false;
  int trigger_line = -1;  // camera trigger, one pulse a frame
};

// `table` is [gpio]. Throws ConfigError.
GpioConfig read_gpio_config(ConfigTable& table);

// What the LED tells from across a field.
enum class LedPattern {
  kOff,
  kStarting,   // slow even blink
  kReady,      // short flash every two seconds
  kTracking,   // steady
  kTrouble,    // fast blink: an alarm holds
  kEmergency,  // double flash
};

class Gpio {
 public:
  // `on_stop(pressed)` is called from Gpio's thread at every edge of the emergency stop and once
  // for its first level; the lines gone or unreadable counts as pressed when stop_line is
  // configured.
  Gpio(const GpioConfig& config, std::function<void(bool pressed)> on_stop);
  ~Gpio();
  Gpio(const Gpio&) = delete;
  Gpio& operator=(const Gpio&) = delete;

  void show(LedPattern pattern);
  void trigger();  // a pulse on trigger_line
  bool stop_pressed() const;
  DeviceReport report() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols
