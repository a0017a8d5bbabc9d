#include <algorithm>
#include <vector>

#include "edge/gpio/gpio.h"

namespace ols {

GpioConfig read_gpio_config(ConfigTable& table) {
  GpioConfig c;
  const auto line = [&table](const char* key, int fallback) {
    return static_cast<int>(table.integer(key, fallback, -1, 1023));
  };
  c.chip = table.text("chip", c.chip);
  c.led_line = line("led_line", c.led_line);
  c.stop_line = line("stop_line", c.stop_line);
  c.stop_active_low = table.boolean("stop_active_low", c.stop_active_low);
  c.stop_release_s = table.number("stop_release_s", c.stop_release_s, 0.0, 5.0);
  c.rearm_line = line("rearm_line", c.rearm_line);
  c.rearm_active_low = table.boolean("rearm_active_low", c.rearm_active_low);
  c.rearm_hold_s = table.number("rearm_hold_s", c.rearm_hold_s, 0.2, 10.0);
  const std::string rearm = table.text("rearm", "station");
  if (rearm != "station" && rearm != "bus") throw table.error("rearm", "\"station\" or \"bus\"");
  c.rearm_over_bus = rearm == "bus";
  c.trigger_line = line("trigger_line", c.trigger_line);
  c.trigger_pulse_s = table.number("trigger_pulse_s", c.trigger_pulse_s, 1e-5, 0.1);

  std::vector<int> used;
  for (const auto& [key, number] : {std::pair("led_line", c.led_line),
                                    {"stop_line", c.stop_line},
                                    {"rearm_line", c.rearm_line},
                                    {"trigger_line", c.trigger_line}}) {
    if (number < 0) continue;
    if (c.chip.empty()) throw table.error(key, "is given, but no chip");
    if (std::ranges::count(used, number) != 0) throw table.error(key, "is used twice");
    used.push_back(number);
  }
  return c;
}

}  // namespace ols
