#include "edge/command/command_turn.h"

namespace ols::station {

void CommandTurn::designate(const DesignateCommand& command, const CommandId& id) {
  if (designation_) drop_designation(Refusal::kOvertaken);
  designation_ = {command, id};
}

void CommandTurn::drop_designation(Refusal why) {
  ++superseded_;
  decisions_.push_back({designation_->second, why});
  designation_.reset();
}

void CommandTurn::before_other_command(double now_s) {
  if (designated_ && designation_) drop_designation(Refusal::kOvertaken);
  carry_out_designation(now_s);
}

void CommandTurn::carry_out_designation(double now_s) {
  if (!designation_) return;
  // Following a designation costs tracker time; a stop does not wait for it.
  if (stop_) return drop_designation(Refusal::kStopped);
  designated_ = true;
  const auto [command, id] = *std::exchange(designation_, std::nullopt);
  decisions_.push_back({id, station_.designate(command, now_s)});
}

void CommandTurn::end(double now_s) {
  carry_out_designation(now_s);
  designated_ = false;
  // Last, so that no earlier command of this turn moves the unit after the stop.
  if (stop_.exchange(false)) station_.stop(now_s);
}

}  // namespace ols::station
