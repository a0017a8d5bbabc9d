// The sightings that stations have told (OLS_SIGHTING_*), out of recordings of the bus.
#pragma once

#include <string>
#include <vector>

#include "base/progress.h"
#include "calibration/followed_tracks.h"

namespace ols::calibration {

struct SightingLog {
  std::vector<FollowedSighting> sightings;  // of the stations asked for
  std::size_t unusable = 0;                 // malformed, of another schema, with impossible values
  std::size_t unsynchronised = 0;           // the station did not know the time
  std::size_t disbelieved = 0;              // the tracker hardly believed it
  std::size_t of_others = 0;                // of stations that were not asked for
  std::vector<std::string> damage;  // of each damaged recording, with its places; it is left out
};

struct SightingLogOptions {
  std::vector<std::string> recordings;
  double least_belief = 0.5;
};

// std::runtime_error naming a file that cannot be read, or a station whose unit counts otherwise
// than its instrument says. `tell`: of the bytes of all recordings.
SightingLog read_sightings(const SightingLogOptions& options, const std::vector<std::string>& names,
                           const std::vector<StationPrior>& stations, const TellSteps& tell = {});

}  // namespace ols::calibration
