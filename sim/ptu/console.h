// The lines that ols-sim-ptu reads from its standard input. Pure.
//
//   fault KIND [SECONDS [VALUE]]   begins a fault; KIND as in a scenario, with or without "ptu-";
//                                  without SECONDS, the fault lasts until it is ended
//   end KIND | end all             ends the faults of this kind, or all faults
//   angles [MONOTONIC_S]           asks for the true angles now, or at an instant of the last two
//                                  seconds
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
