// ols-calibrate tracks: converts the targets that stations followed in recordings to observations.
#pragma once

#include <string>

#include "tools/calibrate/calibrate_case.h"
#include "tools/calibrate/command_report.h"
#include "tools/calibrate/sighting_log.h"

namespace ols::calibration {

struct TracksOptions {
  CaseOptions stations;  // configurations and instruments
  SightingLogOptions log;
  std::string aircraft;  // references.csv of `ols-calibrate aircraft`; empty: none
  std::string output;
};

// Reads the recordings and writes the observations. Throws std::runtime_error naming file or
// option.
CommandReport write_tracks(const TracksOptions& options);

}  // namespace ols::calibration
