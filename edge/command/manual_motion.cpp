#include "edge/command/manual_motion.h"

namespace ols::station {

void ManualMotion::point(const PanTilt& angles, double now_s, double until_s) {
  rate_.reset();
  point_ = mount::Goal{now_s, angles, {}, until_s};
  point_->rests = true;
}

void ManualMotion::turn(const RateCommand& command) {
  point_.reset();
  rate_ = command;
}

void ManualMotion::clear() {
  point_.reset();
  rate_.reset();
}

bool ManualMotion::overtakes(const RateCommand& command, double now_s) const {
  return rate_ && rate_->sender == command.sender && rate_->sequence > command.sequence &&
         now_s <= ends_s(*rate_);
}

std::optional<mount::Goal> ManualMotion::goal(double now_s) const {
  if (point_) {
    mount::Goal here = *point_;  // stationary: still valid
    here.time_s = now_s;
    return here;
  }
  const bool rests = !rate_ || (rate_->rate.pan_rad == 0.0 && rate_->rate.tilt_rad == 0.0);
  if (rests || now_s > ends_s(*rate_)) return std::nullopt;
  mount::Goal goal{now_s, {}, rate_->rate, ends_s(*rate_)};
  goal.rate_only = true;
  return goal;
}

}  // namespace ols::station
