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

// One exposure of a followed object, as the station reports it.
struct FollowedSighting {
  std::size_t station = 0;  // the station's index
  std::int64_t boot_id = 0, track_id = 0;
  std::int64_t utime_us = 0;  // UTC
  UnitReading reading;        // approach 0 if unknown
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double sd_px = 0.0;
  double clock_sd_s = 0.0;
};

// A sighting at a whole second, interpolated between the exposures before and after that second.
// Its sd_px includes the error of the clock.
using Instant = FollowedSighting;

struct Instants {
  std::vector<Instant> instants;  // sorted by station and time
  std::size_t lonely = 0;  // sightings without a partner on the other side of the whole second
  std::size_t unsure = 0;  // pairs of sightings whose approach is unknown or differs
};

// `stations`: the priors of the stations, as far as known; used only to limit the speed of a
// target.
Instants instants_of(std::vector<FollowedSighting> sightings,
                     const std::vector<StationPrior>& stations);

struct FollowedObservations {
  std::vector<Observation> observations;  // sorted by kind, then by name and time
  // Which objects became an aircraft or a track, and which did not.
  std::vector<std::string> remarks;
};

using TellTracks = std::function<void(std::size_t done, std::size_t all)>;

// The sightings of an object that moves like an aircraft of `references` become sightings of that
// aircraft. Any other object that several stations see at the same instants becomes a track, one
// for each combination of the stations' own tracks. `tell` is called after each object has been
// compared with all aircraft.
FollowedObservations followed(const std::vector<Instant>& instants,
                              const std::vector<StationPrior>& stations,
                              const std::vector<std::string>& names, const References& references,
                              const TellTracks& tell = {});

}  // namespace ols::calibration
