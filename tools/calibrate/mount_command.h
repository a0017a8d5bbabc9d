// ols-calibrate mount: measures the errors of the positions that an ONVIF camera reports, without a
// person's help.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "base/trust/trust_config.h"

namespace ols::calibration {

struct MountOptions {
  std::string station, state_folder, lcm_url;
  trust::TrustConfig trust{};
  bool write = false;
};

CLI::App* add_mount(CLI::App& app, MountOptions& options);

// Returns the exit status: 0, or 1 if an axis could not be measured. Throws for bad input, and
// std::runtime_error if nothing can be measured.
int run_mount(const MountOptions& options);

}  // namespace ols::calibration
