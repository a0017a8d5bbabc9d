// The GPIO's state, and the report about it in the station's status message. Pure.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "edge/device/device_report.h"
#include "edge/gpio/gpio_config.h"

namespace ols::gpio {

// The facts from which the report is made.
struct GpioFacts {
  bool open = false;
  bool readable = false;          // a level has been read since the lines were opened
  std::optional<bool> pressed{};  // state of the emergency stop at the last call of on_stop
  std::optional<double> last_good_s{};
  std::string error{};
  std::uint64_t failures = 0, presses = 0, rearms = 0, triggers = 0;
};

// Whether the emergency stop counts as pressed. True also while its level has not been read yet;
// false without a stop_line.
bool stop_pressed(const GpioConfig& config, const GpioFacts& facts);

device::DeviceReport make_gpio_report(const GpioConfig& config, const GpioFacts& facts);

}  // namespace ols::gpio
