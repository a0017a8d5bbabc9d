// Simulates a click in the overview station's picture, and measures in simulated time how long
// tracking stations that have never seen the target take to follow it.
#pragma once

#include <cstdint>

#include "sim/lockstep/lead_times.h"

namespace ols::sim {

struct ClickConfig {
  double elapsed_s = 0.0;  // the scenario starts this long after the beginning of the flight
  double aimed_s = 2.0;    // when the operator turns the station towards the target
  double clicked_s = 4.5;  // when the operator clicks on the target
  double zoom = 0.3;       // the zoom position at the click, as a share of the lens's travel
  double patience_s = 20.0;
};

// The scenario must have an overview station and a target. The simulation draws all pictures: ten
// simulated seconds of five stations take a minute on two processors. Throws std::runtime_error if
// the click finds nothing.
LeadTimes click_in_overview(const Scenario& scenario, std::uint64_t seed,
                            const ClickConfig& config);

}  // namespace ols::sim
