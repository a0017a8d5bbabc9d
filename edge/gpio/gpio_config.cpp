// The keys of [gpio].
#include "edge/gpio/gpio_config.h"

#include <algorithm>
#include <vector>

#include "base/config/config_section.h"

namespace ols::gpio {
namespace {

void check_lines(ConfigTable& table, const GpioConfig& c) {
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
}

}  // namespace

config::Section gpio_section(GpioConfig& c) {
  const auto line = [](const char* key, int& field, const char* sentence) {
    return config::integer(key, field, -1, 1023, "", sentence);
  };
  return {
      "gpio",
      "Status LED, emergency stop, re-arming and camera trigger.",
      {config::text("chip", c.chip,
                    "/dev/gpiochip0, or socket:PATH for lines that another process serves; empty: "
                    "none.")
           .required_with_section(),
       line("led_line", c.led_line, "Line of the status LED; -1: none."),
       line("stop_line", c.stop_line,
            "Line of the emergency stop, a normally closed contact; -1: none."),
       config::flag("stop_active_low", c.stop_active_low,
                    "false: the contact closes to ground (pull-up); true: to the supply "
                    "(pull-down)."),
       config::number("stop_release_s", c.stop_release_s, {0.0, 5.0}, "s",
                      "A release counts when stable for this long; a press counts at once."),
       line("rearm_line", c.rearm_line,
            "Line of the button that re-arms after an emergency stop, normally open; -1: none."),
       config::flag("rearm_active_low", c.rearm_active_low,
                    "true: the button closes to ground (pull-up); false: to the supply "
                    "(pull-down)."),
       config::number("rearm_hold_s", c.rearm_hold_s, {0.2, 10.0}, "s",
                      "The button must be seen open, and then be held for this long."),
       config::word("rearm", c.rearm_over_bus, {{"station", false}, {"bus", true}},
                    "Who may re-arm: only the button, or also any program on the bus."),
       line("trigger_line", c.trigger_line, "Line of the camera trigger; -1: none."),
       config::number("trigger_pulse_s", c.trigger_pulse_s, {1e-5, 0.1}, "s",
                      "Length of a trigger pulse.")},
      {},
      [&c](ConfigTable& table) { check_lines(table, c); }};
}

}  // namespace ols::gpio
