// Finds the most helpful next sighting. For each candidate, predicts the systematic error that
// would remain after sighting the candidate, over the directions in which a station works.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibration/groups.h"
#include "calibration/systematic.h"

namespace ols::calibration {

// A possible next step: one or more sightings that would be made together. Their readings,
// references and deviations are used; their pixels are not.
struct Candidate {
  std::string name;
  std::vector<Observation> sightings;
};

struct Advice {
  std::size_t candidate = 0;  // index of the candidate
  // The systematic error predicted after the sightings, per axis.
  double rms_rad = 0.0, worst_rad = 0.0;
};

// Candidates, sorted by the error of `station` that would remain after each; smallest first.
// `so_far`: the observations, possibly none. `model`: the station as far as it is known; its
// heading must be known to some degrees. Candidates that cannot be used (a star too low, a target
// behind the camera) are left out.
std::vector<Advice> rank_sightings(const Problem& so_far, std::size_t station,
                                   const StationModel& model,
                                   const std::vector<Candidate>& candidates,
                                   const WorkingVolume& volume = {});

// The systematic error that would remain after a plan's observations. The observations' pixels are
// not used.
VolumePrecision planned_precision(const Problem& plan, std::size_t station,
                                  const StationModel& model, const WorkingVolume& volume = {});

// The counts at which a point or a direction appears at this pixel, if the unit arrives there from
// these directions of approach. nullopt if there are none.
std::optional<UnitReading> reading_towards(const StationModel& model, const HomogeneousPoint& point,
                                           const Eigen::Vector2d& pixel, int approach_pan = 1,
                                           int approach_tilt = 1);

}  // namespace ols::calibration
