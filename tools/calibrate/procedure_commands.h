// The subcommands field, workshop, rectify, sweep, check, history and revert of ols-calibrate:
// their options, and how each is put together from its parts.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "base/trust/trust_config.h"
#include "tools/calibrate/ut1_value.h"

namespace ols::calibration {

struct ProcedureOptions {
  std::string name;  // of the procedure
  std::string station, state_folder, lcm_url;
  trust::TrustConfig trust{};
  std::string references, instrument, script, to, targets, panorama;
  int sweep_poses = 60, rounds = 2, stars = 0;
  bool sun = false, overcast = false;
  std::string drone;
  int drone_points = 40;
  std::optional<std::string> resume;  // a folder; empty: the newest one
  Ut1Value ut1;
  std::optional<double> pressure_hPa, temperature_degC;
};

// Adds --ut1-utc and --ut1-date, which `adjust` has too.
void add_ut1(CLI::App& app, Ut1Value& ut1);

// Adds the subcommands. After parsing, `options` has the name of the chosen one.
void add_procedures(CLI::App& app, ProcedureOptions& options);

// Returns the exit status. 0: accepted or done; 1: the old calibration stays in use, or the
// procedure was aborted. Throws for bad input.
int run_procedure(const ProcedureOptions& options);

}  // namespace ols::calibration
