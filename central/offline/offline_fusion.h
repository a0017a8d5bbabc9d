// Fusion of recorded bearings of one object.
//
// Every estimator uses bearings up to 0.15 s after the instant for which it computes. The filter
// runs up to that time, and its state is propagated back. The other estimators interpolate each
// station's bearings from both sides of the instant, and take undeclared errors from a run of the
// filter. Smoothing uses all later bearings (smoother.h).
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
  std::string estimator = "filter";  // a name for make_estimator()
  bool smooth = false;               // only possible with the filter
  // For the filter: the position at an instant also uses bearings up to this long after it, as the
  // interpolating estimators do. 0: only earlier bearings, as in live operation.
  double look_ahead_s = 0.15;
  double rate_hz = 0.0;   // rate of epochs on an even grid; 0 for one epoch at each bearing
  FusionConfig fusion{};  // as in the live fusion
  // Called after every bearing that a filter has processed; with `smooth`, on the workers' threads.
  std::function<void()> tell{};
  Workers workers{};  // for `smooth`
};

// Numbers of bearings that fuse_offline() leaves out before it checks the geometry.
struct UnusedBearings {
  std::size_t low_belief = 0;
  std::size_t duplicate = 0;  // same station and stamp as an earlier bearing, which is used
};

struct OfflineReport {
  UnusedBearings unused{};
  Unlocated unlocated{};  // numbers of instants without a position
  // For each station whose bearings missed the other stations' target by the same angle for some
  // seconds: that angle as text.
  std::map<std::string, std::string> beside{};
};

// For a recording that says nothing about its clocks: sets each station's clock error [s] to the
// time in which the object, at its usual angular speed, moves by half of a bearing's noise; at most
// 0.02 s (half a video frame). A clock error therefore matters as much for a meteor as for a drone.
// With BiasModelConfig::clock_weight, the bearings refine the guess.
void guess_clocks(const MutableBearings& measurements);
void guess_clocks(std::vector<BearingMeasurement>& measurements);

// Takes one object's bearings in any order. Passes to `take` a target for each epoch that has a
// position, in order of time. The caller must leave out bearings that check() refuses. Throws
// std::invalid_argument for a rate that is not finite or gives more than ten million epochs, for an
// unknown estimator, and for smoothing with an estimator other than the filter. Apart from the
// bearings themselves, the filter needs the same memory for any number of bearings, and smoothing
// little more. The other estimators copy the bearings.
OfflineReport fuse_offline(const BearingPointers& measurements, const OfflineConfig& config,
                           const std::function<void(FusedTarget)>& take);

// As above; returns all targets at once.
std::vector<FusedTarget> fuse_offline(const std::vector<BearingMeasurement>& measurements,
                                      const OfflineConfig& config, OfflineReport* report = nullptr);

}  // namespace ols::fusion
