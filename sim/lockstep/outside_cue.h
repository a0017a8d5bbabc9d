// A cue from outside, in simulated time: measures the time until the stations, which have never
// seen the target, see and follow it.
#pragma once

#include <cstdint>

#include "sim/lockstep/lead_times.h"

namespace ols::sim {

struct OutsideCueConfig {
  double elapsed_s = 0.0;        // of the flight before the scenario's start
  double given_s = 2.0;          // when the operator allows the cue; it exists from the start
  double sd_m = 20.0;            // of the cue's positions, stated and true, each axis
  bool with_velocity = true;     // false: the source states only the position
  double velocity_sd_m_s = 1.0;  // of the stated velocity
  double report_s = 1.0;         // interval of the source's reports
  double delay_s = 0.3;          // from the instant of a position to its arrival
  double patience_s = 20.0;
};

// The scenario must have one target. With pictures, two processors need a minute for ten seconds of
// four stations.
LeadTimes cue_from_outside(const Scenario& scenario, std::uint64_t seed,
                           const OutsideCueConfig& config);

}  // namespace ols::sim
