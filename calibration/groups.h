// Builds the blocks and groups of an adjustment from its observations.
#pragma once

#include <string>
#include <vector>

#include "calibration/block.h"
#include "calibration/sky.h"

namespace ols::calibration {

struct Problem {
  std::vector<std::string> names;  // the stations' names
  std::vector<StationPrior> stations;
  std::vector<Observation> observations;
  References references;
  std::optional<Air> air;  // the standard atmosphere if nullopt
  EarthRotation earth;
  // 1-sigma of the sum of two errors: of UT1, and of the clock that stamps the sightings. They need
  // not be separated, because both turn the sky in the same way. 0.3 if UT1 is unknown: UT1 is
  // always within a second of UTC.
  double ut1_sd_s = 0.3;
};

// Observations that are kept or rejected together: all sightings of a landmark; one sighting of a
// star; one pass of an aircraft; one track; or all scene points.
struct Group {
  Kind kind = Kind::kLandmark;
  std::string name;
  std::size_t station = 0;  // the station of its first sighting
  std::vector<std::size_t> blocks;
  std::vector<std::size_t> observations;  // in the order of the blocks' sightings
  int degrees_of_freedom = 0;
  bool is_tested() const { return kind != Kind::kScene; }
  // Whether a single sighting of the group can be mistaken while the other sightings are right.
  bool is_followed() const {
    return kind == Kind::kDrone || kind == Kind::kAircraft || kind == Kind::kTrack;
  }
  // Whether the group shows where a station looks: a person has stated where its target is.
  bool is_absolute() const {
    return is_tested() && kind != Kind::kTrack && kind != Kind::kInclinometer &&
           !is_rectification_target(kind);
  }
};

struct Network {
  Layout layout;
  std::vector<StationPrior> stations;
  std::vector<std::string> names;
  std::vector<BlockPtr> blocks;  // first the blocks of observations, then those of priors
  std::vector<Group> groups;
  std::size_t priors_from = 0;  // index of the first block that is a prior
  double ut1_sd_s = 0.3;
};

// Builds the network of a problem. Throws ObservationRefused in these cases: a reference is missing
// or of the wrong kind; a star has no reference; a star or the sun is too low; only one station
// sees a track; an instant is outside a trajectory; sightings with the same pose number have
// different counts.
Network network_of(const Problem& problem);

// The network with the sightings of one station only: the same global parameters, fewer groups.
Network alone(const Network& network, std::size_t station);

}  // namespace ols::calibration
