// What stations have followed, as observations: the same unknown target at the same instants
// (tracks), and aircraft that announce themselves.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "calibration/observation.h"
#include "calibration/state.h"

namespace ols::calibration {

// As a station tells it: one exposure.
struct FollowedSighting {
  std::size_t station = 0;  // index
  std::int64_t boot_id = 0, track_id = 0;
  std::int64_t utime_us = 0;  // UTC
  UnitReading reading;        // approach 0: not known
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double sd_px = 0.0;
  double clock_sd_s = 0.0;
};

// The same at a whole second, between the exposures before and after it; what the clock may be off
// is in its sd_px.
using Instant = FollowedSighting;

struct Instants {
  std::vector<Instant> instants;  // by station and time
  std::size_t lonely = 0;         // sightings without another one across a whole second
  std::size_t unsure = 0;         // pairs with an approach that is not known, or not the same
};

// `stations`: as far as they are known; only for how fast a target moves.
Instants instants_of(std::vector<FollowedSighting> sightings,
                     const std::vector<StationPrior>& stations);

struct FollowedObservations {
  std::vector<Observation> observations;  // by kind, then name and time
  std::vector<std::string> remarks;       // what became an aircraft, a track; what did not
};

using TellTracks = std::function<void(std::size_t done, std::size_t all)>;

// What flies as an aircraft of `references` becomes that aircraft; of the others, what several
// stations see at the same instants becomes one track for each set of the stations' own tracks.
// `tell` is called for each of these, when it has been compared with all aircraft.
FollowedObservations followed(const std::vector<Instant>& instants,
                              const std::vector<StationPrior>& stations,
                              const std::vector<std::string>& names, const References& references,
                              const TellTracks& tell = {});

}  // namespace ols::calibration
