// Measures how long, in simulated time, stations that have never seen the target take to follow it.
// The stations are led to it by a click (overview_click.h) or a cue (outside_cue.h).
#pragma once

#include <map>
#include <optional>
#include <string>

#include "sim/lockstep/lockstep.h"
#include "sim/scenario/scenario.h"

namespace ols::sim {

// Times in seconds after the click or cue, by station. A map has no entry for a station that never
// got that far.
struct LeadTimes {
  std::map<std::string, double> in_picture;  // until the target is in its picture
  std::map<std::string, double> acquired;    // until it first tries to follow a detected object
  std::map<std::string, double> follows;     // until it tracks the target in its picture
  std::map<std::string, int> acquisitions;   // number of objects tried so far
  std::optional<double> located;             // until the fusion has a position
  std::size_t stations = 0;  // number of stations that are expected to follow the target

  bool complete() const { return follows.size() == stations; }
};

// note() records what station `id` has reached; note_position() records that the fusion has a
// position. Call both regularly. `after_s`: time since the click or cue.
void note(LeadTimes& times, Lockstep& lockstep, const std::string& id, double after_s);
void note_position(LeadTimes& times, const Lockstep& lockstep, double after_s);

// The same scenario without the first `by_s` seconds of the targets' flights.
Scenario later(Scenario scenario, double by_s);
Fidelity nobody_designates(const Scenario& scenario);

}  // namespace ols::sim
