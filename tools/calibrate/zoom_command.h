// ols-calibrate zoom: drives a station's zoom lens through its travel, and measures the focal
// length at each position from still scenery and the unit's own counts.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "base/trust/trust_config.h"

namespace ols::calibration {

struct ZoomOptions {
  std::string station, state_folder, lcm_url, output;
  trust::TrustConfig trust{};
  int positions = 9;
};

CLI::App* add_zoom(CLI::App& app, ZoomOptions& options);

// Writes the table of focal lengths. Returns the exit status: 0, or 1 if some position could not be
// measured. Throws for bad input, and std::runtime_error if nothing can be measured.
int run_zoom(const ZoomOptions& options);

}  // namespace ols::calibration
