// The GPIO's state in the words of the status message. Pure.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "edge/device/device_report.h"
#include "edge/gpio/gpio_config.h"

namespace ols::gpio {

// The GPIO's state as its thread knows it.
struct GpioFacts {
  bool open = false;
  bool readable = false;          // a level has been read since the lines were opened
  std::optional<bool> pressed{};  // the emergency stop's state at the last callback
  std::optional<double> last_good_s{};
  std::string error{};
  std::uint64_t failures = 0, presses = 0, rearms = 0, triggers = 0;
};

// True also while the first level is not known. False if there is no stop_line.
bool stop_pressed(const GpioConfig& config, const GpioFacts& facts);

device::DeviceReport make_gpio_report(const GpioConfig& config, const GpioFacts& facts);

}  // namespace ols::gpio
