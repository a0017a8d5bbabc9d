// Reads the stations' sightings (channels OLS_SIGHTING_*) from recordings of the bus.
#pragma once

#include <string>
#include <vector>

#include "base/process/progress.h"
#include "calibration/followed_tracks.h"

namespace ols::calibration {

struct SightingLog {
  std::vector<FollowedSighting> sightings;  // of the requested stations
  std::size_t unusable = 0;                 // malformed, of another schema, or with impossible
                                            // values
  std::size_t unsynchronised = 0;           // the station's clock was not synchronised
  std::size_t disbelieved = 0;              // the tracker's belief was too low
  std::size_t of_others = 0;                // of other stations
  // One text per damaged recording, with the places that were skipped.
  std::vector<std::string> damage;
};

struct SightingLogOptions {
  std::vector<std::string> recordings;
  double least_belief = 0.5;
};

// Throws std::runtime_error naming a file that cannot be read, or a station whose unit's counts
// differ from its instrument's. `tell`: receives the progress in bytes of all recordings.
SightingLog read_sightings(const SightingLogOptions& options, const std::vector<std::string>& names,
                           const std::vector<StationPrior>& stations, const TellSteps& tell = {});

}  // namespace ols::calibration
