#include "edge/command_turn.h"

#include <utility>

namespace ols::station {

void CommandTurn::designate(const DesignateCommand& command) {
  if (designation_) ++superseded_;
  designation_ = command;
}

Refusal CommandTurn::before_other_command(double now_s) {
  if (designated_ && designation_) {
    ++superseded_;
    designation_.reset();
  }
  return carry_out_designation(now_s);
}

Refusal CommandTurn::carry_out_designation(double now_s) {
  const auto command = std::exchange(designation_, std::nullopt);
  if (!command) return Refusal::kNone;
  // Following a designation costs tracker time; a stop does not wait for it.
  if (stop_) {
    ++superseded_;
    return Refusal::kNone;
  }
  designated_ = true;
  return station_.designate(*command, now_s);
}

Refusal CommandTurn::end(double now_s) {
  const Refusal refusal = carry_out_designation(now_s);
  designated_ = false;
  // Last, so that no earlier command of this turn moves the unit after the stop.
  if (stop_.exchange(false)) station_.stop(now_s);
  return refusal;
}

}  // namespace ols::station
