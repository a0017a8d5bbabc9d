// A site without any person, in simulated time: when it sees, locates and names what flies there.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>

#include "central/handover/handover_policy.h"
#include "sim/lockstep/lead_times.h"
#include "sim/scenario/scenario.h"

namespace ols::sim {

// Of one target of the scenario; in seconds of the scenario.
struct FoundTarget {
  std::optional<double> seen_s;     // first on a line of sight of the fusion
  std::optional<double> located_s;  // first at a position
  std::optional<double> named_s;    // first with its class
  int wrong_names = 0;              // publications with another class than its own or 'unknown'
  std::set<std::int64_t> identities;
};

struct UnattendedRun {
  std::map<std::string, FoundTarget> targets;  // by the scenario's id
  std::set<std::int64_t> ghosts;               // positions where nothing flies
  int drones_that_are_none = 0;                // publications: what would have raised an alarm
  std::size_t stations_on_it = 0;              // that track the first target at the end
  LeadTimes first;                             // of the scenario's first target
};

// Nobody designates, and targets of these classes lead stations at once.
UnattendedRun run_unattended(const Scenario& scenario, std::uint64_t seed, double seconds,
                             const std::vector<fusion::ObjectClass>& classes);

}  // namespace ols::sim
