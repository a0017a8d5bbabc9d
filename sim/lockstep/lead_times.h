// How long it takes in simulated time until stations that have never seen the target follow it.
// overview_click.h and outside_cue.h lead the stations there.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "sim/lockstep/lockstep.h"
#include "sim/scenario/scenario.h"

namespace ols::sim {

// Seconds after the event, by station. A station that did not get this far is missing.
struct LeadTimes {
  std::map<std::string, double> in_picture;  // until the target is in its picture
  std::map<std::string, double> acquired;    // until it tries a detected object
  std::map<std::string, double> follows;     // until it tracks the target in its picture
  std::map<std::string, int> acquisitions;   // number of objects tried so far
  std::optional<double> located;             // the fusion has a position
  std::size_t stations = 0;                  // number of stations that are to follow

  bool complete() const { return follows.size() == stations; }
};

void note(LeadTimes& times, Lockstep& lockstep, const std::string& id, double after_s);
void note_position(LeadTimes& times, const Lockstep& lockstep, double after_s);

// The same flight, of which the first by_s are left out.
Scenario later(Scenario scenario, double by_s);
Fidelity nobody_designates(const Scenario& scenario);

}  // namespace ols::sim
