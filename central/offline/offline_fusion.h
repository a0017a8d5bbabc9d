// Fusion of recorded bearings of one object.
//
// The filter is causal: a fix uses only the bearings up to its instant, as live. Smoothing also
// uses the later ones (smoother.h). The other estimators interpolate each station's bearings on
// both sides of the instant; a run of the filter provides the errors that the stations do not
// declare.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "central/fusion/fusion.h"
#include "central/offline/bearing_pointers.h"
#include "central/offline/tasks.h"

namespace ols::fusion {

struct OfflineConfig {
  std::string estimator = "filter";  // a name of make_estimator()
  bool smooth = false;               // only for the filter
  double rate_hz = 0.0;              // epochs on an even grid; 0: at the instant of every bearing
  FusionConfig fusion{};             // shared with the live fusion
  // Called for every bearing that a filter has processed, with `smooth` by the workers.
  std::function<void()> tell{};
  Workers workers{};  // for `smooth`
};

// Bearings that fuse_offline leaves out before it checks the geometry.
struct UnusedBearings {
  std::size_t low_belief = 0;
  std::size_t duplicate = 0;  // the same station and stamp: the first is used
};

// What a run shows besides positions.
struct OfflineReport {
  UnusedBearings unused{};
  Unlocated unlocated{};  // instants without a position
  // Stations whose bearings are off the target of the other stations by the same angle for seconds,
  // with that angle as text.
  std::map<std::string, std::string> beside{};
};

// For a recording without statements on its clocks: sets for each station the offset [s] that would
// move a bearing by four times its noise at the object's usual angular speed, at most 0.02 s (half
// a video frame). A clock thus counts as much for a meteor as for a drone.
void guess_clocks(const MutableBearings& measurements);
void guess_clocks(std::vector<BearingMeasurement>& measurements);

// One object's bearings, in any order. Passes on a target for each epoch that has a position, in
// order of time. Bearings that check() refuses must be left out. Throws std::invalid_argument for a
// rate that is not finite or makes more than ten million epochs, for an unknown estimator, and for
// smoothing with an estimator other than the filter.
// The memory it needs besides the bearings does not grow with their number for the filter, and
// hardly for smoothing; the other estimators copy the bearings.
OfflineReport fuse_offline(const BearingPointers& measurements, const OfflineConfig& config,
                           const std::function<void(FusedTarget)>& take);

// The same with all targets in memory.
std::vector<FusedTarget> fuse_offline(const std::vector<BearingMeasurement>& measurements,
                                      const OfflineConfig& config, OfflineReport* report = nullptr);

}  // namespace ols::fusion
