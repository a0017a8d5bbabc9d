// The lines of a station's GPIO, and the biases of its inputs.
#pragma once

#include "edge/gpio/gpio_config.h"
#include "edge/gpio/gpio_lines.h"

namespace ols::gpio {

// The line of the emergency stop, which must be configured. It is biased towards "pressed", so that
// a broken wire reads as an open contact.
LineInput stop_input_line(const GpioConfig& config);
// All configured lines.
LineUse line_use(const GpioConfig& config);

}  // namespace ols::gpio
