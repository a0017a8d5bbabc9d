// A site without operators, in simulated time: measures when the site first sees, locates and
// classifies each flying object.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>

#include "central/handover/handover_policy.h"
#include "sim/lockstep/lead_times.h"
#include "sim/scenario/scenario.h"

namespace ols::sim {

// When the site found one target of the scenario, in seconds of the scenario.
struct FoundTarget {
  std::optional<double> seen_s;     // time of the first line of sight or position near the target
  std::optional<double> located_s;  // time of the first position near the target
  std::optional<double> named_s;    // when it was first published with the right class
  int wrong_names = 0;              // publications with a wrong class; 'unknown' is not wrong
  std::set<std::int64_t> identities;
};

struct UnattendedRun {
  std::map<std::string, FoundTarget> targets;  // by the target's id in the scenario
  std::set<std::int64_t> ghosts;               // ids of targets published where nothing flies
  // Number of publications that call something else a drone; each would raise an alarm.
  int drones_that_are_none = 0;
  std::size_t stations_on_it = 0;  // number of stations that follow the first target at the end
  LeadTimes first;                 // to the scenario's first target, from the start of the scenario
};

// Runs a scenario in which nobody designates. Targets of these classes lead stations at once,
// without an operator's permission.
UnattendedRun run_unattended(const Scenario& scenario, std::uint64_t seed, double seconds,
                             const std::vector<fusion::ObjectClass>& classes);

}  // namespace ols::sim
