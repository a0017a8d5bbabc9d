// Fusion of recorded bearings of one object.
//
// The filter is causal: a fix at an instant comes from the bearings up to it, as live. Smoothing
// uses those after it too (smoother.h). The other estimators interpolate each station's bearings
// between those on both sides of the instant; what the stations do not tell of their errors they
// have from a run of the filter.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "central/fusion/fusion.h"

namespace ols::fusion {

struct OfflineConfig {
  std::string estimator = "filter";  // a name of make_estimator()
  bool smooth = false;               // the filter's alone
  double rate_hz = 0.0;              // epochs on an even grid; 0: at the instant of every bearing
  FusionConfig fusion{};             // what it shares with the live one
  std::function<void()> tell{};      // called with every bearing that the filter has taken
};

// What fuse_offline leaves out before it looks at the geometry.
struct UnusedBearings {
  std::size_t low_belief = 0;
  std::size_t duplicate = 0;  // the same station and stamp: the first is taken
};
UnusedBearings unused_bearings(const std::vector<BearingMeasurement>& sightings,
                               const OfflineConfig& config);

// For a recording that does not tell how good its clocks are: states for each station the offset
// [s] that would move a bearing by four times its noise at the object's usual angular speed, and
// half a frame of video, 0.02 s, at most. So a clock counts as much with a meteor as with a drone.
void guess_clocks(std::vector<BearingMeasurement>& sightings);

// One object's bearings, in any order. One target for each epoch that has a position, in order of
// time; of the others it is counted why. Bearings that check() refuses must not be among them.
// std::invalid_argument for a rate that is not finite or makes more than ten million epochs, for an
// unknown estimator, and for another one than the filter smoothed.
std::vector<FusedTarget> fuse_offline(const std::vector<BearingMeasurement>& sightings,
                                      const OfflineConfig& config, Unlocated* unlocated = nullptr);

// Stations whose bearings are for seconds off the others' target by the same angle, and by how
// much, in words; by station. A run of the filter by itself.
std::map<std::string, std::string> stations_beside(const std::vector<BearingMeasurement>& sightings,
                                                   const OfflineConfig& config);

}  // namespace ols::fusion
