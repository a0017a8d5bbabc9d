// The filter on a recording, with the bearings after each instant too (fixed-interval smoothing).
//
// Two filters, one forwards and one backwards in time (Fraser and Potter, 1969): at each instant
// the forward one's state, which contains the bearings up to it, is joined with the backward one's
// prediction, which contains those after it. Both have the biases' prior in them, once too often:
// it is taken out. What the stations do not tell of their errors is learnt in a run before; who
// looked beside the target in that takes part in no start.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "central/estimators/estimator.h"
#include "central/tracking/recorded_track.h"

namespace ols::fusion {

struct Smoothed {
  std::int64_t utime_us = 0;
  Located located;
};

// What a run over the bearings has shown of the stations.
struct KnownStations {
  BiasModel errors;
  std::set<std::string> beside;
};

// One object's bearings and the instants, both in order of time; positions only. Of the other
// instants it is counted why.
std::vector<Smoothed> smooth(const std::vector<BearingMeasurement>& bearings,
                             const std::vector<std::int64_t>& epochs,
                             const TrackManagerConfig& config, const KnownStations& known,
                             Unlocated& unlocated);

}  // namespace ols::fusion
