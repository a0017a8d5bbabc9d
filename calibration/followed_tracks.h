// Observations from objects that stations followed: an unknown target seen at the same instants (a
// track), or an aircraft that broadcasts its position.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "calibration/observation.h"
#include "calibration/state.h"

namespace ols::calibration {

// One exposure, as the station reports it.
struct FollowedSighting {
  std::size_t station = 0;  // index
  std::int64_t boot_id = 0, track_id = 0;
  std::int64_t utime_us = 0;  // UTC
  UnitReading reading;        // approach 0: unknown
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double sd_px = 0.0;
  double clock_sd_s = 0.0;
};

// The same at a whole second, interpolated between the exposures before and after that second. Its
// sd_px includes the clock error.
using Instant = FollowedSighting;

struct Instants {
  std::vector<Instant> instants;  // by station and time
  std::size_t lonely = 0;  // sightings without a second one on the other side of a whole second
  std::size_t unsure = 0;  // pairs whose approach is unknown or not the same
};

// `stations`: as far as they are known. They serve only to bound the speed of a target.
Instants instants_of(std::vector<FollowedSighting> sightings,
                     const std::vector<StationPrior>& stations);

struct FollowedObservations {
  std::vector<Observation> observations;  // by kind, then name and time
  std::vector<std::string> remarks;       // what became an aircraft or a track, and what did not
};

using TellTracks = std::function<void(std::size_t done, std::size_t all)>;

// An object that flies as an aircraft of `references` becomes that aircraft. Any other object that
// several stations see at the same instants becomes a track: one for each set of the stations' own
// tracks. `tell` is called for each object after its comparison with all aircraft.
FollowedObservations followed(const std::vector<Instant>& instants,
                              const std::vector<StationPrior>& stations,
                              const std::vector<std::string>& names, const References& references,
                              const TellTracks& tell = {});

}  // namespace ols::calibration
