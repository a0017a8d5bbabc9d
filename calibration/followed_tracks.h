// Makes observations from objects that stations followed with their trackers. Such an object is
// either an aircraft that broadcasts its position, or an unknown target that several stations saw
// at the same instants (a track).
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "calibration/observation.h"
#include "calibration/state.h"

namespace ols::calibration {

// One exposure of a followed object, as the station reports it.
struct FollowedSighting {
  std::size_t station = 0;  // the station's index
  std::int64_t boot_id = 0, track_id = 0;
  std::int64_t utime_us = 0;  // UTC
  UnitReading reading;        // approach 0 if unknown
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double sd_px = 0.0;       // 1-sigma of each coordinate
  double clock_sd_s = 0.0;  // 1-sigma of utime_us
};

// A sighting at a whole second, interpolated between the exposures before and after it. Its sd_px
// includes the error of the clock.
using Instant = FollowedSighting;

struct Instants {
  std::vector<Instant> instants;  // sorted by station and time
  // Sightings that were left out, because their track has no sighting that is at most 0.25 s away
  // and on the other side of a whole second.
  std::size_t lonely = 0;
  std::size_t unsure = 0;  // pairs of sightings whose directions of approach are unknown or differ
};

// `stations`: the stations as far as they are known. They are needed to convert a clock error to
// pixels, by the speed of the target.
Instants instants_of(std::vector<FollowedSighting> sightings,
                     const std::vector<StationPrior>& stations);

struct FollowedObservations {
  std::vector<Observation> observations;  // sorted by kind, then by name and time
  // Which objects were recognised as an aircraft or as a track, and which were left out.
  std::vector<std::string> remarks;
};

using TellTracks = std::function<void(std::size_t done, std::size_t all)>;

// If an object moves like an aircraft of `references`, its sightings become sightings of that
// aircraft. The sightings of all other objects that several stations see at the same instants
// become tracks, one for each combination of the stations' local tracks. `tell` is called after
// each object has been compared with all aircraft.
FollowedObservations followed(const std::vector<Instant>& instants,
                              const std::vector<StationPrior>& stations,
                              const std::vector<std::string>& names, const References& references,
                              const TellTracks& tell = {});

}  // namespace ols::calibration
