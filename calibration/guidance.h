// Which sighting helps most: what each would leave of the systematic error over the directions in
// which a station works, before it is made.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibration/groups.h"
#include "calibration/systematic.h"

namespace ols::calibration {

// One thing that a person or a program could do next: sightings, all of which would be made. Their
// pixels do not matter; reading, reference and deviations do.
struct Candidate {
  std::string name;
  std::vector<Observation> sightings;
};

struct Advice {
  std::size_t candidate = 0;              // index
  double rms_rad = 0.0, worst_rad = 0.0;  // predicted, of an axis, once it is made
};

// The candidates by what they would leave of `station`'s error, the best first. `so_far`: what has
// been observed, may be nothing; `model`: the station as far as it is known, its heading to some
// degrees at least. Candidates that cannot be used (too low a star, a target behind the camera) are
// left out.
std::vector<Advice> rank_sightings(const Problem& so_far, std::size_t station,
                                   const StationModel& model,
                                   const std::vector<Candidate>& candidates,
                                   const WorkingVolume& volume = {});

// The systematic error that the observations would leave, whatever their pixels: of a plan.
VolumePrecision planned_precision(const Problem& plan, std::size_t station,
                                  const StationModel& model, const WorkingVolume& volume = {});

// The counts that bring a point or a direction onto a pixel, approached from these sides; nothing
// where none do.
std::optional<UnitReading> reading_towards(const StationModel& model, const HomogeneousPoint& point,
                                           const Eigen::Vector2d& pixel, int approach_pan = 1,
                                           int approach_tilt = 1);

}  // namespace ols::calibration
