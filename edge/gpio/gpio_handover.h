// Connects the control loop to the owner of the GPIO lines; the owner is a derived class such as
// Gpio. Handles the status LED, the inputs for emergency stop and re-arming, and the optional
// camera trigger.
//
// The emergency stop by software is only an addition to a hardware stop that cuts the power of the
// motors (docs/field-guide.md).
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

  // turn() and failed() call `on_stop` for the first level of the emergency stop and at each
  // change. If a stop_line is configured, the stop counts as pressed while the lines are missing or
  // unreadable. turn() calls `on_rearm` each time the button has been held long enough while the
  // stop is not pressed.
  GpioHandover(const GpioConfig& config, OnStop on_stop, OnRearm on_rearm);
  virtual ~GpioHandover() = default;
  GpioHandover(const GpioHandover&) = delete;
  GpioHandover& operator=(const GpioHandover&) = delete;

  // The next four functions may be called from any thread; none of them waits for the device.
  void show(LedPattern pattern);
  void trigger();  // sends a pulse on trigger_line
  // Whether the emergency stop counts as pressed. True also while its level has not been read yet;
  // false without a stop_line.
  bool stop_pressed() const;
  device::DeviceReport report() const;

  // The functions below are for the owner of the lines, which must call all of them from one
  // thread. Call opened() when the lines have been opened, and failed() when they cannot be opened
  // or have failed.
  void opened();
  void failed(const std::string& what);
  // Reads the inputs, calls the callbacks, and drives the outputs. Returns the time of the next
  // call [s, CLOCK_MONOTONIC]. Call it at this time, and also at each edge and at each wake().
  // Throws std::system_error, as GpioLines does.
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
  // Used only by the thread that calls turn():
  StopInput stop_;
  RearmInput rearm_;
  double refresh_s_ = 0.0;
  std::optional<bool> lit_;          // as last written to the line
  double trigger_end_s_ = kNever_s;  // end of the current trigger pulse

  mutable std::mutex mutex_;  // guards everything below
  GpioFacts facts_;
  LedPattern pattern_ = LedPattern::kOff;
  double pattern_began_s_ = 0.0;
  bool trigger_wanted_ = false;
};

}  // namespace ols::gpio
