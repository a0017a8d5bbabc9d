// A click in the overview station's picture, in simulated time: how long it takes until the
// tracking stations, which have never seen the target, follow it.
#pragma once

#include <cstdint>

#include "sim/lockstep/lead_times.h"

namespace ols::sim {

struct ClickConfig {
  double elapsed_s = 0.0;  // of the flight before the scenario's start: moves the target
  double aimed_s = 2.0;    // the operator turns the station towards the target,
  double clicked_s = 4.5;  // clicks on it,
  double zoom = 0.3;       // and has zoomed in by this share of the lens's travel
  double patience_s = 20.0;
};

// The scenario has an overview station and a target. Cost with pictures: a minute of two processors
// for ten seconds of five stations. Throws std::runtime_error if the click finds nothing.
LeadTimes click_in_overview(const Scenario& scenario, std::uint64_t seed,
                            const ClickConfig& config);

}  // namespace ols::sim
