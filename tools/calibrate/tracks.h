// ols-calibrate tracks: what stations followed in recordings, as observations.
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

// Writes. Throws std::runtime_error naming file or option.
CommandReport write_tracks(const TracksOptions& options);

}  // namespace ols::calibration
