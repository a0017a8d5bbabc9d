// ols-calibrate tracks: what stations have followed, out of recordings, as observations.
#pragma once

#include <string>
#include <vector>

#include "tools/calibrate/calibrate_case.h"
#include "tools/calibrate/sighting_log.h"

namespace ols::calibration {

struct TracksOptions {
  CaseOptions stations;  // configurations and instruments
  SightingLogOptions log;
  std::string aircraft;  // references.csv as `ols-calibrate aircraft` writes it; empty: none
  std::string output;
};

// Writes, and returns what a person should know. std::runtime_error naming file or option.
std::vector<std::string> write_tracks(const TracksOptions& options);

}  // namespace ols::calibration
