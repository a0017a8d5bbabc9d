// The station's GPIO: connects the control loop to the owner of the lines (Gpio, whose thread waits
// for edges). Handles the status LED, the inputs for emergency stop and re-arming, and the optional
// camera trigger.
//
// The emergency stop in software only assists a hardware stop that cuts the power of the motors
// (docs/field-guide.md).
#pragma once

#include <functional>
#include <limits>
#include <mutex>
#include <optional>
#include <string>

#include "edge/device/device_report.h"
#include "edge/gpio/gpio_config.h"
#include "edge/gpio/gpio_lines.h"
#include "edge/gpio/gpio_report.h"
#include "edge/gpio/led_pattern.h"
#include "edge/gpio/rearm_input.h"
#include "edge/gpio/stop_input.h"

namespace ols::gpio {

class GpioHandover {
 public:
  using OnStop = std::function<void(bool pressed)>;
  using OnRearm = std::function<void()>;

  // `on_stop` is called from turn() and failed(): at every edge of the emergency stop, and once for
  // its first level. If a stop_line is configured, missing or unreadable lines count as pressed.
  // `on_rearm` is called each time the button has been held while the stop is not pressed.
  GpioHandover(const GpioConfig& config, OnStop on_stop, OnRearm on_rearm);
  virtual ~GpioHandover() = default;
  GpioHandover(const GpioHandover&) = delete;
  GpioHandover& operator=(const GpioHandover&) = delete;

  // May be called from any thread; none of these waits for the device.
  void show(LedPattern pattern);
  void trigger();  // sends a pulse on trigger_line
  // True also while the first level is not known. False without a stop_line.
  bool stop_pressed() const;
  device::DeviceReport report() const;

  // The functions below are for the owner of the lines, which calls all of them from one thread.
  // Call opened() or failed() when the lines have been opened or have failed.
  void opened();
  void failed(const std::string& what);
  // Call at each edge, at each wake(), and at the instant that the last call returned [s,
  // CLOCK_MONOTONIC]. Throws what GpioLines throws.
  double turn(GpioLines& lines);
  void leave(GpioLines& lines) const;

 private:
  virtual void wake() {}

  void take_levels(GpioLines& lines);
  void tell_stop();
  void tell(bool pressed);
  void tell_rearm();
  double next_led_slot_s(double now_s) const;
  void drive_led(GpioLines& lines);
  void drive_trigger(GpioLines& lines);

  static constexpr double kNever_s = std::numeric_limits<double>::infinity();

  const GpioConfig config_;
  const OnStop on_stop_;
  const OnRearm on_rearm_;
  // Used only by turn()'s thread:
  StopInput stop_;
  RearmInput rearm_;
  double refresh_s_ = 0.0;
  std::optional<bool> lit_;          // as written to the line
  double trigger_end_s_ = kNever_s;  // end of the pulse that is on the line

  mutable std::mutex mutex_;  // guards everything below
  GpioFacts facts_;
  LedPattern pattern_ = LedPattern::kOff;
  double pattern_began_s_ = 0.0;
  bool trigger_wanted_ = false;
};

}  // namespace ols::gpio
