// Runs the filter on a recording with the bearings before and after each instant (fixed-interval
// smoothing).
//
// One filter runs forwards in time, another one backwards (Fraser and Potter, 1969). At each
// instant the forward state (from the bearings up to the instant) is combined with the backward
// prediction (from the later bearings). Both use the biases of the more certain filter. The
// undeclared errors of the stations come from an earlier run. A station that missed the target in
// that run takes part in no track initiation.
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

// What the first run has shown about the stations.
struct KnownStations {
  BiasModel errors{};
  std::set<std::string> beside{};
};

struct SmootherOutput {
  // Called in order of time; without a position, it gets the reason.
  std::function<void(Smoothed)> take{};
  // Called after every bearing that a filter has processed, on the workers' threads.
  std::function<void()> tell{};
  Workers workers{};
};
// The number of times that each bearing is processed, for this number of instants.
std::size_t smoother_runs(std::size_t epochs);

// `bearings`: those of one object. Bearings and epochs are both in order of time. The backward
// filter is stored at the ends of blocks and run again within each block, so memory grows with the
// root of the number of instants.
void smooth(const BearingPointers& bearings, const std::vector<std::int64_t>& epochs,
            const TrackManagerConfig& config, const KnownStations& known,
            const SmootherOutput& output);

}  // namespace ols::fusion
