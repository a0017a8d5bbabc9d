#include "edge/command/active_occlusion.h"

namespace ols::station {

bool ActiveOcclusion::give(const OcclusionCommand& command) {
  const bool same = command_ && command_->sender == command.sender;
  if (same && command.made_s < command_->made_s) return false;
  command_.reset();
  if (command.holds_s > 0.0) command_ = command;
  return true;
}

void ActiveOcclusion::expire(double now_s) {
  if (command_ && now_s > command_->received_s + command_->holds_s) command_.reset();
}

std::optional<SlewCommand> ActiveOcclusion::exit() const {
  if (!command_ || !command_->exit) return std::nullopt;
  SlewCommand slew;
  slew.effect_s = command_->exit->time_s;
  slew.received_s = command_->received_s;
  slew.lease_s = command_->holds_s;
  slew.sender = command_->sender;
  slew.target_id = command_->target_id;
  slew.direction = command_->exit->direction;
  slew.direction_sd_rad = command_->exit->direction_sd_rad;
  return slew;
}

std::optional<mount::Goal> ActiveOcclusion::goal(const PointingModel& pointing,
                                                 double now_s) const {
  if (!command_ || !command_->exit) return std::nullopt;
  const auto angles = pointing.aim(command_->exit->direction);
  if (!angles) return std::nullopt;
  return mount::Goal{.time_s = now_s,
                     .angles = *angles,
                     .valid_until_s = command_->received_s + command_->holds_s,
                     .rests = true};
}

}  // namespace ols::station
