// Decides which faults are active at which time. The faults come from a scenario's [[fault]]
// tables, and from commands while the site runs. Pure; deterministic.
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "sim/scenario/faults.h"

namespace ols::sim {

struct Fault {
  std::string kind;     // "ptu-line-cut", ...: fault_kinds()
  std::string station;  // empty: all stations
  double at_s = 0.0;    // since the scenario's start
  double for_s = std::numeric_limits<double>::infinity();
  double value = std::numeric_limits<double>::quiet_NaN();  // NaN: the kind's default
};

std::vector<std::string> fault_kinds();

// What is wrong with a fault, and the key of the scenario that is wrong; both are empty for a valid
// fault.
struct FaultProblem {
  std::string key, what;
};
FaultProblem check(const Fault& fault);

class FaultPlan {
 public:
  // Throws std::invalid_argument, with the text from check(), if the fault is invalid.
  void add(const Fault& fault);

  // Applies a command from `now_s` on. A command with for_s = 0 ends the current and planned faults
  // of its kind ("all": of every kind) at its station (empty: at all stations).
  void command(Fault fault, double now_s);

  // The faults of one station at one instant. If faults of one kind overlap, the one that began
  // last applies.
  StationFaults at(std::string_view station, double time_s) const;

 private:
  void forget(double before_s);
  std::vector<Fault> faults_;  // in the order of addition
};

}  // namespace ols::sim
