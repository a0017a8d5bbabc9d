// ols-calibrate delay: finds the constant delay of a camera's pictures, from an object that other
// stations saw at the same time.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace ols::calibration {

struct DelayOptions {
  std::string station;
  std::vector<std::string> recordings;
  bool write = false;
};

CLI::App* add_delay(CLI::App& app, DelayOptions& options);

// Returns the exit status: 0, or 1 if not all of the input was used. Throws for bad input, and
// std::runtime_error if the recordings show no delay.
int run_delay(const DelayOptions& options);

}  // namespace ols::calibration
