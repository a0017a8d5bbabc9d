#include "sim/ptu/faults.h"

#include "geometry/angles.h"

namespace ols::sim {

FaultyPtuUnit::FaultyPtuUnit(const PtuUnitConfig& config, std::uint64_t seed, double power_up_s)
    : unit_(config, seed, power_up_s), replies_(seed ^ 0x5eed) {}

void FaultyPtuUnit::set_faults(const PtuFaults& faults, double time_s) {
  if (faults.power_cycle && !faults_.power_cycle) {
    if (faults.homes_then) unit_.home_at_power_up(*faults.homes_then);
    unit_.power_cycle(time_s);
  }
  if (faults.echo_on && !faults_.echo_on) unit_.switch_echo_on(time_s);
  if (faults.lost_steps_deg != 0.0 && faults_.lost_steps_deg == 0.0) {
    unit_.slip(radians(faults.lost_steps_deg), time_s);
  }
  replies_.set(faults.garble_share, faults.reply_lost_every_s, time_s);
  faults_ = faults;
}

void FaultyPtuUnit::receive(std::string_view bytes, double time_s) {
  unit_.receive(open() ? bytes : std::string_view(), time_s);
}

std::string FaultyPtuUnit::transmit(double time_s) {
  const std::string sent = unit_.transmit(time_s);
  return open() ? replies_.pass(sent, time_s) : std::string();
}

}  // namespace ols::sim
