// The blocks and groups of an adjustment, made from its observations.
#pragma once

#include <string>
#include <vector>

#include "calibration/block.h"
#include "calibration/sky.h"

namespace ols::calibration {

struct Problem {
  std::vector<std::string> names;  // of the stations
  std::vector<StationPrior> stations;
  std::vector<Observation> observations;
  References references;
  std::optional<Air> air;  // else the standard atmosphere's
  EarthRotation earth;
  double ut1_sd_s = 0.3;  // not stated: it stays within a fraction of a second of UTC
};

// What is kept or rejected as one: all sightings of a landmark, one sighting of a star, a pass of
// an aircraft, a track; of scene points all together.
struct Group {
  Kind kind = Kind::kLandmark;
  std::string name;
  std::size_t station = 0;  // that sees it first
  std::vector<std::size_t> blocks;
  std::vector<std::size_t> observations;  // in the order of the blocks' sightings
  int degrees_of_freedom = 0;
  bool is_tested() const { return kind != Kind::kScene; }
  // Whether one sighting of many can be mistaken, and the others are still good.
  bool is_followed() const {
    return kind == Kind::kDrone || kind == Kind::kAircraft || kind == Kind::kTrack;
  }
  // Whether it tells where a station looks: somebody has said where its target is.
  bool is_absolute() const {
    return is_tested() && kind != Kind::kTrack && kind != Kind::kInclinometer &&
           !is_rectification_target(kind);
  }
};

struct Network {
  Layout layout;
  std::vector<StationPrior> stations;
  std::vector<std::string> names;
  std::vector<BlockPtr> blocks;  // the observations' first, then the priors
  std::vector<Group> groups;
  std::size_t priors_from = 0;  // the first block that is a prior
};

// ObservationRefused: a reference that is missing or of the wrong sort, a star
// without reference, a star or the sun too low, a track that one station alone sees, an
// instant outside of a trajectory, a pose that stands at two places.
Network network_of(const Problem& problem);

// Of a network what one station has sighted, as if there were no other: the same globals, fewer
// groups.
Network alone(const Network& network, std::size_t station);

}  // namespace ols::calibration
