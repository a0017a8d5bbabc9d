#include "edge/gpio/gpio_report.h"

#include "conditions/alarms.h"

namespace ols::gpio {

bool stop_pressed(const GpioConfig& config, const GpioFacts& facts) {
  return config.has_stop() && facts.pressed.value_or(true);
}

device::DeviceReport make_gpio_report(const GpioConfig& config, const GpioFacts& facts) {
  const bool pressed = stop_pressed(config, facts);
  device::DeviceReport report;
  report.name = "gpio";
  report.last_good_s = facts.last_good_s;
  report.last_error = facts.error;
  report.errors = facts.failures;
  report.counters = {{"gpio_failures", facts.failures},
                     {"gpio_stop_presses", facts.presses},
                     {"gpio_rearms", facts.rearms},
                     {"gpio_triggers", facts.triggers}};
  if (facts.open && facts.readable) {
    report.state = device::DeviceState::kOk;
    report.text = config.chip;
    if (config.has_stop()) report.text += pressed ? ", stop pressed" : ", stop released";
    if (pressed) report.alarms.push_back(alarm::gpio_stop_pressed());
  } else if (facts.open || facts.failures == 0) {
    report.state = device::DeviceState::kStarting;
    report.text = config.chip + ": waiting for the first level";
  } else {
    report.state = device::DeviceState::kAbsent;
    report.text = facts.error;
    report.alarms.push_back(config.has_stop() ? alarm::gpio_stop_unreadable(facts.error)
                                              : alarm::gpio_fails(facts.error));
  }
  return report;
}

}  // namespace ols::gpio
