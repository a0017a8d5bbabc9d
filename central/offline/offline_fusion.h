// Fusion of recorded bearings of one object.
//
// Every estimator uses bearings up to 0.15 s after the instant. The filter runs to that time, and
// its state is propagated back. The other estimators interpolate each station's bearings on both
// sides of the instant; a run of the filter gives them the errors that the stations do not declare.
// Smoothing uses all later bearings (smoother.h).
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
  // For the filter: the fix at an instant also uses the bearings of this time after it, as the
  // interpolating estimators do. 0: as live.
  double look_ahead_s = 0.15;
  double rate_hz = 0.0;   // epochs on an even grid; 0: one at each bearing
  FusionConfig fusion{};  // shared with the live fusion
  // Called for every bearing that a filter has processed; with `smooth`, by the workers.
  std::function<void()> tell{};
  Workers workers{};  // for `smooth`
};

// Bearings that fuse_offline leaves out before it checks the geometry.
struct UnusedBearings {
  std::size_t low_belief = 0;
  std::size_t duplicate = 0;  // the same station and stamp: the first is used
};

struct OfflineReport {
  UnusedBearings unused{};
  Unlocated unlocated{};  // instants without a position
  // Stations whose bearings missed the other stations' target by the same angle for seconds, and
  // that angle as text.
  std::map<std::string, std::string> beside{};
};

// For a recording that says nothing of its clocks: sets each station's clock error [s] to the
// offset that would move a bearing by half its noise at the object's usual angular speed, at most
// 0.02 s (half a video frame). A clock thus counts as much for a meteor as for a drone. With
// BiasModelConfig::clock_weight the bearings refine it.
void guess_clocks(const MutableBearings& measurements);
void guess_clocks(std::vector<BearingMeasurement>& measurements);

// Takes one object's bearings in any order. Passes on a target for each epoch that has a position,
// in order of time. The caller leaves out bearings that check() refuses. Throws
// std::invalid_argument for a rate that is not finite or makes more than ten million epochs, for an
// unknown estimator, and for smoothing with an estimator other than the filter. Apart from the
// bearings themselves, the filter's memory does not grow with their number, and that of smoothing
// hardly does. The other estimators copy the bearings.
OfflineReport fuse_offline(const BearingPointers& measurements, const OfflineConfig& config,
                           const std::function<void(FusedTarget)>& take);

// The same with all targets in memory.
std::vector<FusedTarget> fuse_offline(const std::vector<BearingMeasurement>& measurements,
                                      const OfflineConfig& config, OfflineReport* report = nullptr);

}  // namespace ols::fusion
