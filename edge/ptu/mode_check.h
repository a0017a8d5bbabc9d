// Echo or verbose replies that come on while a unit is ready are switched off again, without a new
// start. But the unit may have been switched off and on, and then takes speeds for velocities or
// has other ramps: it gets no motion command before it has answered that it has not. Pure.
#pragma once

#include <cstdint>

#include "edge/ptu/poll_cycle.h"

namespace ols {

class ModeCheck {
 public:
  // The acceleration of pan [counts/s^2] that the unit stated at its start.
  explicit ModeCheck(std::int32_t pan_acceleration) : pan_acceleration_(pan_acceleration) {}

  bool needed() const { return needed_; }
  // What the next cycle contains as long as a check is needed.
  static PtuRequest commands();
  static PtuRequest questions();

  // A cycle is sent, and its replies are complete.
  void begin_cycle() { checking_ = needed_; }
  enum class Result {
    kUnchanged,
    kForgotten,      // the unit has begun to echo or to be verbose
    kRestored,       // it is as it was
    kUnitRestarted,  // several checks have failed
  };
  Result take(const PollCycle& done);

 private:
  std::int32_t pan_acceleration_;
  bool needed_ = false;
  bool checking_ = false;  // in the cycle that is under way
  int failed_ = 0;
};

}  // namespace ols
