#include "edge/command/active_slew.h"

#include "geometry/angles.h"

namespace ols::station {

void ActiveSlew::give(const SlewCommand& command, double now_s) {
  command_ = command;
  senders_.note(command.sender, now_s);
}

void ActiveSlew::expire(double now_s) {
  if (command_ && is_over(now_s)) command_.reset();
}

std::optional<mount::Goal> ActiveSlew::goal(const PointingModel& pointing, double now_s) const {
  if (!command_ || is_over(now_s)) return std::nullopt;
  constexpr double kStep_s = 0.05;
  const double effect_s = command_->effect_s;
  const auto goal = pointing.aim(command_->direction);
  // The rate is the chain's: a unit's errors change it by thousandths, its backlash is no motion.
  const auto here = aim_along(pointing.geometry(), command_->direction);
  const auto later = aim_along(pointing.geometry(), direction_at(*command_, effect_s + kStep_s));
  if (!goal || !here || !later) return std::nullopt;
  const PanTilt rate{wrap_pi(later->pan_rad - here->pan_rad) / kStep_s,
                     (later->tilt_rad - here->tilt_rad) / kStep_s};
  return mount::Goal{effect_s, *goal, rate, command_->received_s + command_->lease_s};
}

}  // namespace ols::station
