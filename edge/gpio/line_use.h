// The GPIO lines that a station uses, and the bias (pull-up or pull-down) of each input.
#pragma once

#include "edge/gpio/gpio_config.h"
#include "edge/gpio/gpio_lines.h"

namespace ols::gpio {

// The line of the emergency stop, which must be configured. Its bias pulls it to the level
// "pressed", so that a broken wire acts as an open contact.
LineInput stop_input_line(const GpioConfig& config);
// All configured lines.
LineUse line_use(const GpioConfig& config);

}  // namespace ols::gpio
