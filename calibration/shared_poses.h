// Poses of a unit in which several things were sighted: the errors of the unit's two angles are the
// same for all sightings of a pose.
#pragma once

#include <optional>
#include <vector>

#include "calibration/observation.h"

namespace ols::calibration {

// The matrices of an adjustment have two rows for each shared pose. With this number of poses they
// take 230 MB.
inline constexpr std::size_t kMostSharedPoses = 1000;

class SharedPoses {
 public:
  // Sightings with the same pose number share one pose. Sightings without a pose number share one
  // if they have the same time and counts, because they are from one picture. Throws
  // ObservationRefused if one number occurs with different counts, or if there are more shared
  // poses than can be adjusted.
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
