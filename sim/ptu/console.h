// The lines that ols-sim-ptu reads from its standard input. Pure.
//
//   fault KIND [SECONDS [VALUE]]   as in a scenario, KIND with or without its "ptu-"; without
//                                  SECONDS until ended
//   end KIND | end all             ends it
//   angles [MONOTONIC_S]           true angles now, or at an instant of the last two seconds
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "sim/scenario/fault_plan.h"

namespace ols::sim {

class PtuConsole {
 public:
  struct AskedAngles {
    std::optional<double> at_s;
  };
  // Handles a line. Returns the text to print (empty for an empty line), or a query for angles.
  std::variant<std::string, AskedAngles> take(std::string_view line, double now_s);

  PtuFaults faults(double now_s) const { return plan_.at("", now_s).ptu; }

 private:
  std::string fault(Fault wanted, double now_s);
  FaultPlan plan_;
};

}  // namespace ols::sim
