// ols-calibrate delay: finds the constant delay of a camera's pictures, from an object that other
// stations saw at the same time, or from a light that GNSS time switches.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "calibration/light_fit.h"

namespace ols::calibration {

struct DelayOptions {
  std::string station;
  std::vector<std::string> recordings{};
  bool write = false;
  std::string light{};  // the folder of a recorded event; empty: `recordings` are used
  BlinkingLight blinking{};
};

CLI::App* add_delay(CLI::App& app, DelayOptions& options);

// Returns the exit status: 0, or 1 if not all of the input was used. Throws for bad input, and
// std::runtime_error if the input shows no delay.
int run_delay(const DelayOptions& options);

}  // namespace ols::calibration
