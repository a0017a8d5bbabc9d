// A cue from outside, in simulated time: how long it takes until the stations, which have never
// seen the target, see and follow it.
#pragma once

#include <cstdint>

#include "sim/lockstep/lead_times.h"

namespace ols::sim {

struct OutsideCueConfig {
  double elapsed_s = 0.0;        // of the flight before the scenario's start
  double given_s = 2.0;          // when the operator allows it; it exists from the start
  double sd_m = 20.0;            // of its positions, stated and true, each axis
  bool with_velocity = true;     // false: its source states only the position
  double velocity_sd_m_s = 1.0;  // of the stated velocity
  double report_s = 1.0;         // interval of its source's positions
  double delay_s = 0.3;          // from a position to its arrival
  double patience_s = 20.0;
};

// The scenario has one target. Cost with pictures: a minute of two processors for ten seconds of
// four stations.
LeadTimes cue_from_outside(const Scenario& scenario, std::uint64_t seed,
                           const OutsideCueConfig& config);

}  // namespace ols::sim
