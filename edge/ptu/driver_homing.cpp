// When a unit is told to home, and what is believed of it then.
#include "edge/ptu/driver_impl.h"

namespace ols {

bool PtuDriver::Impl::may_home() const {
  return config.rehome == PtuRehome::kWhenUnreferenced && rehoming_allowed && !homed &&
         !emergency && !reference.broken();
}

// Only a unit that stands: the start sequence has halted it.
bool PtuDriver::Impl::home_if(bool wanted, double time_s) {
  home_wanted = false;
  if (!wanted || emergency) return false;
  homed = homing = true;
  ++counters.homings;
  phase = Phase::kHoming;
  outstanding = false;
  sent_s = time_s;
  return true;
}

void PtuDriver::Impl::want_home(double time_s) {
  if (emergency || phase == Phase::kHoming) return;
  if (steady) urgent = halt_request();
  begin(time_s);
  home_wanted = homing = true;
}

void PtuDriver::Impl::give_up_homing(double time_s) {
  home_wanted = homing = false;
  if (phase == Phase::kHoming) begin(time_s);
}

// Whoever leaves it before it is over has a unit that nobody knows where it is.
void PtuDriver::Impl::leave_homing() {
  if (phase == Phase::kHoming && outstanding) reference.homing_interrupted();
}

std::string PtuDriver::Impl::step_homing(double time_s) {
  if (!outstanding) {
    outstanding = true;
    sent_s = time_s;
    reference.homing_ordered();
    return " R ";
  }
  if (time_s - sent_s > kLongestHoming_s) fault(time_s, "homing does not end");
  return {};
}

// Its `*` comes behind the limit hits. What comes at once is late and of something else; one
// that comes without them proves nothing.
void PtuDriver::Impl::take_homing_reply(const PtuReply& reply, double time_s) {
  if (!outstanding) return;
  const bool both = reference.saw_both_ends();
  if (!reply.ok) return fault(time_s, "homing refused: " + reply.text);
  if (!both && time_s - sent_s < kShortestHoming_s) return;
  if (both) {
    reference.homing_over();
    outstanding = false;
  }
  begin(time_s);
}

}  // namespace ols
