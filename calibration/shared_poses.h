// The stops of a unit from which several things were sighted: the errors of its two angles are the
// same for all of them.
#pragma once

#include <optional>
#include <vector>

#include "calibration/observation.h"

namespace ols::calibration {

// The matrices of an adjustment have two rows for each: of so many, 230 MB in all.
inline constexpr std::size_t kMostSharedPoses = 1000;

class SharedPoses {
 public:
  // Sightings with the same number of pose, and those without one that were taken at the same time
  // at the same counts: of one picture. ObservationRefused: a number that stands at two places, and
  // more of them than can be adjusted.
  explicit SharedPoses(const std::vector<Observation>& observations);

  std::size_t size() const { return stations_.size(); }
  std::size_t station(std::size_t pose) const { return stations_[pose]; }
  // Of an observation; nothing where it shares its stop with no other.
  std::optional<std::size_t> of(std::size_t observation) const { return poses_[observation]; }

 private:
  std::vector<std::size_t> stations_;              // by pose
  std::vector<std::optional<std::size_t>> poses_;  // by observation
};

}  // namespace ols::calibration
