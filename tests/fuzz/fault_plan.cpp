// Faults that a simulated site is told of over the bus: a run of OLS_SIM_FAULT datagrams, each with
// its length. Refused by name, or a plan whose faults end when they are told to.
#include "sim/scenario/fault_plan.h"

#include <cmath>
#include <stdexcept>

#include "base/bus/lcm_bus.h"
#include "ols_msg/sim_fault_t.hpp"
#include "tests/fuzz/fuzz_input.h"

namespace {

void check_shares(const ols::sim::StationFaults& faults) {
  for (const double share : {faults.ptu.garble_share, faults.camera.packet_loss,
                             faults.gnss.garble_share, faults.inclinometer.garble_share}) {
    ols::fuzz::require(share >= 0.0 && share <= 1.0, "a share is one");
  }
  ols::fuzz::require(std::isfinite(faults.gnss.jump_m) && std::isfinite(faults.ptu.lost_steps_deg),
                     "a length is finite");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 4096) return 0;
  ols::fuzz::Input input(data, size);
  ols::sim::FaultPlan plan;
  double now_s = 0.0;
  while (!input.empty()) {
    now_s += 0.1 * input.byte();
    const std::string_view bytes = input.take(input.byte());
    ols_msg::sim_fault_t message;
    if (!ols::decode_exactly(bytes.data(), static_cast<int>(bytes.size()), message)) continue;
    try {
      plan.command({message.kind, message.station, now_s, message.duration_s, message.value},
                   now_s);
    } catch (const std::invalid_argument&) {
      continue;  // refused by name
    }
    check_shares(plan.at(message.station, now_s));
    check_shares(plan.at("a", now_s + 1.0));
  }
  plan.command({"all", "", now_s, 0.0}, now_s);
  ols::fuzz::require(plan.at("a", now_s + 1.0) == ols::sim::StationFaults{},
                     "all faults end by command");
  return 0;
}
