// Simulates a cue from outside, and measures in simulated time how long stations that have never
// seen the target take to see and follow it.
#pragma once

#include <cstdint>

#include "sim/lockstep/lead_times.h"

namespace ols::sim {

struct OutsideCueConfig {
  double elapsed_s = 0.0;        // the scenario starts this long after the beginning of the flight
  double given_s = 2.0;          // when the operator allows the cue; it exists from the start
  double sd_m = 20.0;            // true and stated 1-sigma of the cue's positions, each axis
  bool with_velocity = true;     // false: the source states only the position
  double velocity_sd_m_s = 1.0;  // 1-sigma error of the stated velocity, each axis
  double report_s = 1.0;         // interval of the source's reports
  double delay_s = 0.3;          // from the instant of a position to its arrival
  double patience_s = 20.0;
};

// The scenario must have one target. The simulation draws all pictures: ten simulated seconds of
// four stations take a minute on two processors.
LeadTimes cue_from_outside(const Scenario& scenario, std::uint64_t seed,
                           const OutsideCueConfig& config);

}  // namespace ols::sim
