// ols-calibrate tracks: what stations followed in recordings, as observations.
#pragma once

#include <string>
#include <vector>

#include "tools/calibrate/calibrate_case.h"
#include "tools/calibrate/sighting_log.h"

namespace ols::calibration {

struct TracksOptions {
  CaseOptions stations;  // configurations and instruments
  SightingLogOptions log;
  std::string aircraft;  // references.csv of `ols-calibrate aircraft`; empty: none
  std::string output;
};

struct TracksReport {
  std::vector<std::string> remarks;  // for a person
  bool is_damaged = false;           // a recording; what is left of it was used
};

// Writes. Throws std::runtime_error naming file or option.
TracksReport write_tracks(const TracksOptions& options);

}  // namespace ols::calibration
