// A cue from outside, in simulated time: how long until the stations, none of which has ever seen
// the target, see and follow it.
#pragma once

#include <cstdint>

#include "sim/lead_times.h"

namespace ols::sim {

struct OutsideCueConfig {
  double elapsed_s = 0.0;        // of the flight before the scenario's start
  double given_s = 2.0;          // when the operator allows it; it is there from the start
  double sd_m = 20.0;            // of its places, as it says and as it is, each axis
  bool with_velocity = true;     // else its source says only where the target is
  double velocity_sd_m_s = 1.0;  // of what it says
  double report_s = 1.0;         // between two places of its source
  double delay_s = 0.3;          // from a place to its arrival
  double patience_s = 20.0;
};

// The scenario has a target. With pictures: a minute of two processors for ten seconds of four
// stations.
LeadTimes cue_from_outside(const Scenario& scenario, std::uint64_t seed,
                           const OutsideCueConfig& config);

}  // namespace ols::sim
