// Fuses recorded bearings of one object.
//
// Every estimator uses bearings up to 0.15 s after the instant for which it computes. The filter
// runs up to that time, and its state is then propagated back to the instant. The other estimators
// interpolate each station's bearings from both sides of the instant; a run of the filter gives
// them the undeclared errors. Smoothing also uses all later bearings (smoother.h).
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
  bool smooth = false;               // only with the filter
  // For the filter: the position at an instant uses bearings up to this time after the instant,
  // like the interpolating estimators. 0: only earlier bearings, as in live operation.
  double look_ahead_s = 0.15;
  double rate_hz = 0.0;   // rate of evenly spaced epochs; 0: one epoch at each bearing
  FusionConfig fusion{};  // the settings of the live fusion
  // Called for every bearing that a filter processes; with `smooth`, on the workers' threads.
  std::function<void()> tell{};
  Workers workers{};  // for `smooth`
};

// Numbers of bearings that fuse_offline() leaves out from the beginning.
struct UnusedBearings {
  std::size_t low_belief = 0;
  std::size_t duplicate = 0;  // same station and stamp as another bearing, and not used
};

struct OfflineReport {
  UnusedBearings unused{};
  Unlocated unlocated{};  // numbers of instants without a position
  // Stations whose bearings miss the target of the other stations by the same angle for some
  // seconds: the alarm of the pointing monitor, as text, by station.
  std::map<std::string, std::string> beside{};
};

// For a recording that does not state clock errors: sets each bearing's clock error [s] to the time
// in which the object, at its usual angular speed as this station sees it, moves by half of the
// bearing's noise; at most 0.02 s (half a video frame). The effect of the assumed error is then the
// same for a fast meteor and a slow drone. With BiasModelConfig::clock_weight, the bearings refine
// the guess.
void guess_clocks(const MutableBearings& measurements);
void guess_clocks(std::vector<BearingMeasurement>& measurements);

// Takes one object's bearings in any order. For each epoch with a position, passes a target to
// `take`, in order of time. The caller must leave out bearings that check() refuses. Throws
// std::invalid_argument for a rate that is not finite or gives more than ten million epochs, for an
// unknown estimator, and for smoothing with an estimator other than the filter. Memory: besides the
// bearings, the filter needs a constant amount, and smoothing little more. The other estimators
// copy the bearings.
OfflineReport fuse_offline(const BearingPointers& measurements, const OfflineConfig& config,
                           const std::function<void(FusedTarget)>& take);

// The same, but returns all targets at once.
std::vector<FusedTarget> fuse_offline(const std::vector<BearingMeasurement>& measurements,
                                      const OfflineConfig& config, OfflineReport* report = nullptr);

}  // namespace ols::fusion
