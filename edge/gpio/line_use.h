// Which lines a station's GPIO uses, and how its inputs are biased.
#pragma once

#include "edge/gpio/gpio.h"
#include "edge/gpio/gpio_lines.h"

namespace ols::gpio {

// The emergency stop's line, which the configuration must have. Biased towards "pressed": a broken
// wire then reads as an open contact.
LineInput stop_input_line(const GpioConfig& config);
// All lines that are configured.
LineUse line_use(const GpioConfig& config);

}  // namespace ols::gpio
