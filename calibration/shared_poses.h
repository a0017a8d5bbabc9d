// Shared poses: poses of a unit from which several sightings were made. All sightings of a pose
// share the errors of the unit's two angles.
#pragma once

#include <optional>
#include <vector>

#include "calibration/observation.h"

namespace ols::calibration {

// The largest number of shared poses. The matrices of an adjustment have two rows for each; with
// this number they take 230 MB.
inline constexpr std::size_t kMostSharedPoses = 1000;

class SharedPoses {
 public:
  // Sightings of a station with the same pose number share a pose. Sightings without a pose number
  // share a pose if they have the same time and counts, because they are from one picture. Throws
  // ObservationRefused if one pose number occurs with different counts, or if there are more than
  // kMostSharedPoses.
  explicit SharedPoses(const std::vector<Observation>& observations);

  std::size_t size() const { return stations_.size(); }
  std::size_t station(std::size_t pose) const { return stations_[pose]; }
  // The index of an observation's shared pose; nullopt if no other observation has the same pose.
  std::optional<std::size_t> of(std::size_t observation) const { return poses_[observation]; }

 private:
  std::vector<std::size_t> stations_;              // for each pose
  std::vector<std::optional<std::size_t>> poses_;  // for each observation
};

}  // namespace ols::calibration
