#include "edge/gpio/line_use.h"

namespace ols::gpio {

LineInput stop_input_line(const GpioConfig& config) {
  return {config.stop_line, config.stop_active_low ? LineBias::kPullDown : LineBias::kPullUp};
}

LineUse line_use(const GpioConfig& config) {
  LineUse use;
  if (config.has_stop()) use.inputs.push_back(stop_input_line(config));
  // Towards "open": a broken wire re-arms nothing.
  const LineBias to_open = config.rearm_active_low ? LineBias::kPullUp : LineBias::kPullDown;
  if (config.rearm_line >= 0) use.inputs.push_back({config.rearm_line, to_open});
  for (const int line : {config.led_line, config.trigger_line}) {
    if (line >= 0) use.outputs.push_back(line);
  }
  return use;
}

}  // namespace ols::gpio
