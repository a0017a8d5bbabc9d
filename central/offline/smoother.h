// Estimates the target's state at each instant of a recording from the bearings before and after
// the instant (fixed-interval smoothing).
//
// One filter runs forwards in time, another one backwards (Fraser and Potter, 1969). At each
// instant, the forward filter's state (from the bearings up to the instant) is combined with the
// backward filter's prediction (from the later bearings). The biases of the more certain filter are
// used for both filters. The undeclared errors of the stations come from an earlier run. A station
// that missed the target in that run takes no part in track initiation.
#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "central/estimators/estimator.h"
#include "central/offline/bearing_pointers.h"
#include "central/offline/tasks.h"
#include "central/tracking/recorded_track.h"

namespace ols::fusion {

struct Smoothed {
  std::int64_t utime_us = 0;
  Located located;
};

// What the earlier run has found about the stations. beside: those that missed the target.
struct KnownStations {
  BiasModel errors{};
  std::set<std::string> beside{};
};

struct SmootherOutput {
  // Called for each instant in order of time. If there is no position, the estimate contains the
  // reason.
  std::function<void(Smoothed)> take{};
  // Called for every bearing that a filter processes, on the workers' threads.
  std::function<void()> tell{};
  Workers workers{};
};
// How many times each bearing is processed, for this number of instants.
std::size_t smoother_runs(std::size_t epochs);

// `bearings`: those of one object. Bearings and epochs are both in order of time. Storing the
// backward filter at every instant would need too much memory. It is therefore stored only at the
// ends of blocks, and run again within each block: memory grows with the root of the number of
// instants.
void smooth(const BearingPointers& bearings, const std::vector<std::int64_t>& epochs,
            const TrackManagerConfig& config, const KnownStations& known,
            const SmootherOutput& output);

}  // namespace ols::fusion
