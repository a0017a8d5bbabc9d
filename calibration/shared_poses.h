// Stops of a unit at which several things were sighted: the errors of its two angles are the same
// for all of them.
#pragma once

#include <optional>
#include <vector>

#include "calibration/observation.h"

namespace ols::calibration {

// The matrices of an adjustment have two rows for each shared pose. At this number they take 230 MB
// in all.
inline constexpr std::size_t kMostSharedPoses = 1000;

class SharedPoses {
 public:
  // Sightings with the same pose number share a pose. Sightings without a number share one if they
  // have the same time and counts, because they are from one picture. Throws ObservationRefused for
  // a number at two places, and for more shared poses than can be adjusted.
  explicit SharedPoses(const std::vector<Observation>& observations);

  std::size_t size() const { return stations_.size(); }
  std::size_t station(std::size_t pose) const { return stations_[pose]; }
  // The shared pose of an observation; nullopt if it has its pose alone.
  std::optional<std::size_t> of(std::size_t observation) const { return poses_[observation]; }

 private:
  std::vector<std::size_t> stations_;              // by pose
  std::vector<std::optional<std::size_t>> poses_;  // by observation
};

}  // namespace ols::calibration
